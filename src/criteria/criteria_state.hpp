/// State of the criteria, accumulated over committed steps: part of the state of a run (coupling::State).
///
/// It follows the rules of the state: only a committed step changes it (Criteria::step), a rejected one does
/// not, and a checkpoint holds all of it. Everything is a plain column or table under a name, so the
/// checkpoint writes and reads it without knowing its meaning.
#pragma once

#include <string>
#include <vector>

#include "mesh/field_place.hpp"
#include "mesh/mesh.hpp"

namespace solidus::criteria {

/// Numbers at every node or in every element, SI. Shapes:
///   node  [local node][component], ghosts hold their owner's values;
///   cell  [block of Mesh::blocks][element, counted or not][component], the blocks one behind the other;
///   every
///         process that holds an element computes the same values of it.
struct CriterionColumn {
  std::string name;
  mesh::FieldPlace place = mesh::FieldPlace::node;
  int components = 1;
  std::vector<double> values;
};

/// Rows of numbers that every process holds alike; any number of them.
struct CriterionTable {
  std::string name;
  int width = 1;
  std::vector<double> values;  ///< [row][column]
};

/// State of one criterion. Names and shapes of columns never change during a run.
struct CriterionRecord {
  std::string name;
  std::vector<CriterionColumn> columns;
  std::vector<CriterionTable> tables;
};

/// One record per criterion, in the order of Criteria; empty where nothing is followed.
struct CriteriaState {
  std::vector<CriterionRecord> records;
};

/// A column of zeros (or another value) of the right size.
CriterionColumn make_column(const mesh::Mesh& mesh, std::string name, mesh::FieldPlace place,
                            int components = 1, double value = 0);

}  // namespace solidus::criteria
