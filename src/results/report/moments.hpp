/// The written moments of a run as blocks of a report: every field at the nodes of every body.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "results/report/body_mesh.hpp"
#include "results/report/pack.hpp"

namespace solidus::results {

/// A number at every node that the page can paint.
struct FieldColumn {
  std::string field;         ///< "stress", name in the field files
  std::string name;          ///< "first_principal_stress": that of the page
  std::string component;     ///< "x", "y", "z" of a vector; else empty
  std::string unit;          ///< SI
  int n_components = 1;      ///< of the field in the file
  int index = 0;             ///< of the component
  bool of_elements = false;  ///< means over the elements around a node, by their volumes
  bool principal = false;    ///< the largest principal value of a tensor xx, yy, zz, xy, yz, xz
  bool at_end = false;       ///< of the whole run so far: the last moment has it
  bool none_at_zero = false, none_below_zero = false;  ///< what stands for "nothing to say"
  bool of_contact = false;                             ///< nodes of contact surfaces alone
};

/// The least and the largest value of the elements of a body, and their centres.
struct Extremes {
  bool there = false;
  double low = 0, high = 0;
  mesh::Point low_at{}, high_at{};  ///< [m]
};

struct PackedValues {
  int block = -1;  ///< −1: `low` everywhere; −2: no value anywhere
  int mask = -1;   ///< −1: there is a value everywhere
  double low = 0, high = 0;
};

struct ReportMoment {
  double time = 0;  ///< [s]
  std::filesystem::path file;
};

/// The packed contents of a run's field files.
struct PackedMoments {
  std::vector<ReportMoment> moments;  ///< those that are in the report
  std::vector<FieldColumn> columns;
  std::vector<std::vector<bool>> present;  ///< [moment][body]
  std::vector<std::vector<PackedValues>>
      values;  ///< [column][body], over the moments; `at_end`: of the last one
  std::vector<std::vector<std::vector<Extremes>>> extremes;  ///< [moment][column][body], of element fields
};

/// Fields that the last file has: numbers, the components of vectors, of the stress its largest principal
/// value.
/// @param contact_fields  names of those that only nodes of contact surfaces have
std::vector<FieldColumn> field_columns(const FieldFile& file, const std::set<std::string>& contact_fields);

/// Reads one moment after the other. Moments are thinned out evenly where all of them would take more than
/// `most` bytes of text; the first and the last stay.
/// @param contact_nodes  numbers of the input
PackedMoments pack_moments(Bodies& bodies, const std::vector<ReportMoment>& moments,
                           const std::vector<FieldColumn>& columns,
                           const std::set<std::int64_t>& contact_nodes, std::size_t most, Blocks& blocks);

/// The largest eigenvalue of the symmetric tensor xx, yy, zz, xy, yz, xz.
double largest_principal(const double* tensor);

}  // namespace solidus::results
