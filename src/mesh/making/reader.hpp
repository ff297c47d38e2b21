/// A reader of meshes at work: it is started, asked, waited for, and ended (mesh/making/reader_process.hpp).
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

#include "mesh/making/casting_geometry.hpp"
#include "mesh/making/meshing_outlook.hpp"
#include "mesh/making/reader_process.hpp"
#include "mesh/making/serve.hpp"
#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// What a message advises where the reader is not what it should be.
inline constexpr const char* k_same_build = "the solidus-reader of the same build as this program";

/// A reader at work; it does not outlive this.
class Reader {
 public:
  Reader(const MeshSource& source, const ReaderLimits& limits, const TimeOfWay& time);
  ~Reader();
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// Throws InputError where there is no such program, or it cannot be started.
  void start();
  /// Starts a copy of this process in its place, which answers by `read` and ends. It has its own libraries
  /// in memory already, and reads a small mesh in the time in which the program of the reader is loaded. What
  /// it may do is restricted in the same way.
  void fork(ReadRequest* read);
  /// Sends the request, however slowly the reader takes it; one that does not take it has ended or answers.
  void request(const CastingGeometry* casting);
  /// Reads as much, whatever time it takes within the limit. Throws InputError where the reader ends before,
  /// or does not end.
  void take(void* bytes, std::size_t n);
  /// Takes what messages say of the mesh while it is waited for. Throws UnusableGeometry where it needs more
  /// memory than the reader may use.
  void hear(const MeshingOutlook& outlook);
  const std::string& program() const { return program_; }
  /// Processor time of the reader while it was last waited for [s].
  double processor_time() const { return processor_; }

 private:
  using Clock = std::chrono::steady_clock;

  /// Processor time that the way may take [s].
  double most() const { return time_.processor + nodes_ * time_.processor_a_node; }
  /// Says every now and then what goes on, and throws where it goes on for too long.
  void check_time();
  void give(const void* bytes, std::size_t n);
  /// The reader's ends of both pipes; this process keeps the others.
  struct Pipes {
    int reads = -1, writes = -1;
  };
  Pipes open_pipes();
  /// What a copy of this process does with its ends of the pipes.
  [[noreturn]] static void answer(int reads, int writes, ReadRequest* read);
  /// Waits until the pipe is ready for it (POLLIN, POLLOUT) or the other end has gone.
  void wait_for(int descriptor, short event);
  [[noreturn]] void ended();
  /// How it ended; empty where it goes on, which has closed its end of the pipe.
  std::optional<int> status();

  std::string program_ = {};
  const MeshSource& source_;
  ReaderLimits limits_;
  std::string outlook_;  ///< ": " and a text; empty where nothing is known yet
  Clock::time_point begun_ = Clock::now();
  bool many_nodes_ = false;
  TimeOfWay time_;
  double nodes_ = 0;        ///< that are expected; 0: not known
  double processor_ = 0;    ///< [s]
  double next_report_ = 5;  ///< after so many seconds, then after twice as many, it reports that it goes on
  pid_t pid_ = -1;
  int to_ = -1, from_ = -1;
};

}  // namespace solidus::mesh
