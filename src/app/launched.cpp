#include "app/launched.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "app/descriptors.hpp"
#include "system/log.hpp"
#include "system/processes.hpp"
#include "system/terminal.hpp"

namespace solidus::app {

namespace {

bool started = false;
std::shared_ptr<setup::MadeMesh> handed_mesh;

}  // namespace

setup::MadeMesh take_over(int file) {
  const mesh::TakeBytes take = [&](void* bytes, std::size_t n) { mesh::take_all(file, bytes, n); };
  // The order is that of fill() in the launcher: first the number of warnings, then their text.
  std::size_t n_warnings = 0;
  take(&n_warnings, sizeof n_warnings);
  // A warning that is known is not told again.
  // It is kept all the same, because the results name it.
  logging::set_sink([](logging::Level, std::string_view) {});
  for (std::size_t i = 0; i < n_warnings; ++i) logging::warn("{}", mesh::take_text(take));
  logging::set_sink({});
  constexpr double k_any_size = 1e18;  // [bytes]: it was in the memory of this program already
  return setup::take_made_mesh(take, k_any_size);
}

bool started_by_launcher() {
  return started || std::getenv(k_launcher_variable) != nullptr;
}

bool join_launcher() {
  // Without a launcher there is nothing to join, and the process is one of mpirun or alone.
  const char* name = std::getenv(k_launcher_variable);
  if (name == nullptr) return true;
  started = true;
  const Descriptor launcher = join_meeting(name);
  // Programs that this one starts are none of the launcher's.
  unsetenv(k_launcher_variable);
  // The launcher is told rank and count, by which it sees whether all processes have found each other; it is
  // trusted only if it belongs to the same user.
  if (!launcher.open() || !process_behind(launcher) ||
      !send_files(launcher, fmt::format("{} {}", processes::rank(), processes::count()), {}))
    return false;
  // The answer brings the launcher's own output and error, so that what this process writes goes there
  // without a detour over mpirun.
  std::optional<ReceivedFiles> received = receive_files(launcher);
  constexpr std::size_t k_output_and_error = 2;
  if (!received || received->files.size() < k_output_and_error) return false;
  // The launcher's terminal belongs to another group of processes: writing there is meant.
  std::signal(SIGTTOU, SIG_IGN);
  // Both are replaced at once: mpirun's pipe would otherwise still carry what is written to one of them.
  dup2(received->files[0].number(), STDOUT_FILENO);
  dup2(received->files[1].number(), STDERR_FILENO);
  trust_terminal();
  // Only the first process gets a third file, which holds the mesh.
  if (received->files.size() > k_output_and_error)
    handed_mesh = std::make_shared<setup::MadeMesh>(take_over(received->files[k_output_and_error].number()));
  return true;
}

std::shared_ptr<setup::MadeMesh> mesh_of_launcher() {
  return std::exchange(handed_mesh, nullptr);
}

}  // namespace solidus::app
