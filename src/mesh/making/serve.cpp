/// A request is read, answered by a mesh or a failure, and the memory that it took is told at the end.
#include "mesh/making/serve.hpp"

#include <sys/prctl.h>

#include <csignal>
#include <cstdlib>
#include <exception>
#include <new>
#include <optional>
#include <string>

#include "mesh/making/casting_geometry.hpp"
#include "mesh/making/meshing_outlook.hpp"
#include "mesh/making/reader_message.hpp"
#include "system/errors.hpp"
#include "system/sandbox.hpp"
#include "system/version.hpp"

namespace solidus::mesh {

namespace {

double memory_limit = 0;    ///< of this process [bytes]; 0: none
bool answer_begun = false;  ///< nothing else may be said then

/// Says that memory ran out where a library has ended the process for it, which it does not say to us:
/// libgomp, with which Gmsh 4.13 of Debian 13 computes, calls exit(1) where it gets none.
void tell_memory_at_exit() {
  if (answer_begun || !(memory_limit > 0)) return;
  // A script can end the process as well: then there is memory to be had.
  void* volatile some = std::malloc(static_cast<std::size_t>(memory_limit / 8));
  if (some != nullptr) return;
  try {
    const ReaderAnswer answer = ReaderAnswer::memory;
    put_all(k_answer_descriptor, &answer, sizeof answer);
  } catch (const MessageError&) {  // NOLINT: the program has stopped listening
  }
}

}  // namespace

void serve_request(ReadRequest* read, double held) {
  // The process ends with the one that asks.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  // Ctrl-C reaches all processes of a terminal: the parent decides.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1}) std::signal(signal, SIG_IGN);
  const PutBytes put = [](const void* bytes, std::size_t n) { put_all(k_answer_descriptor, bytes, n); };
  const TakeBytes take = [](void* bytes, std::size_t n) { take_all(k_request_descriptor, bytes, n); };
  const auto say = [&](ReaderAnswer answer) { put(&answer, sizeof answer); };
  // Both must be of the same build, as messages have no format of their own.
  if (const std::string version = take_text(take); !same_build(version, program_version())) {
    say(ReaderAnswer::internal);
    put_text("solidus-reader is of version " + program_version() + ", the program of " + version, put);
    return;
  }
  const MeshSource source = take_source(take);
  bool of_casting = false;
  take(&of_casting, sizeof of_casting);
  std::optional<CastingGeometry> casting;
  if (of_casting) casting = take_casting(take);
  // Memory and rights are limited before anything of the file is read.
  double memory = 0;
  take(&memory, sizeof memory);
  sandbox::limit_memory(memory > 0 ? memory + held : memory);
  memory_limit = memory;
  std::atexit(tell_memory_at_exit);
  if (!source.trust_script) sandbox::forbid_all_but_reading();
  listen_to_outlook([&](const MeshingOutlook& outlook) {
    say(ReaderAnswer::outlook);
    put_outlook(outlook, put);
  });
  // The kind of answer goes first, then the mesh or the text.
  try {
    const std::optional<RawMesh> mesh = read(source, casting ? &*casting : nullptr);
    answer_begun = true;
    say(mesh ? ReaderAnswer::mesh : ReaderAnswer::elsewhere);
    if (mesh) put_mesh(*mesh, put);
  } catch (const UnusableGeometry& error) {
    say(ReaderAnswer::unusable_geometry);
    put_text(error.what(), put);
  } catch (const InputError& error) {
    say(ReaderAnswer::input_error);
    put_text(error.what(), put);
  } catch (const std::bad_alloc&) {
    say(ReaderAnswer::memory);
  } catch (const std::exception& error) {
    say(ReaderAnswer::internal);
    put_text(error.what(), put);
  }
}

}  // namespace solidus::mesh
