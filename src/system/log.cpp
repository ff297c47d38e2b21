/// The level decides what is printed; warnings are also kept.
#include "system/log.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <memory>

#include "system/input_file.hpp"
#include "system/processes.hpp"
#include "system/terminal.hpp"

namespace solidus::logging {
namespace {

struct Log {
  std::shared_ptr<spdlog::logger> terminal;
  std::function<void(Level, std::string_view)> sink;
  std::vector<std::string> warnings;
  Level level = Level::info;

  Log()
      : terminal(std::make_shared<spdlog::logger>("solidus",
                                                  std::make_shared<spdlog::sinks::stderr_color_sink_mt>())) {
    terminal->set_pattern("%^%l:%$ %v");
    using Sink = spdlog::sinks::stderr_color_sink_mt;
    if (!has_colours(STDERR_FILENO))
      static_cast<Sink*>(terminal->sinks().front().get())->set_color_mode(spdlog::color_mode::never);
    terminal->set_level(spdlog::level::debug);  // what is printed is decided by `level` alone
    terminal->flush_on(spdlog::level::info);
  }
};

Log& state() {
  static Log log;
  return log;
}

bool first_process() {
  return !processes::running() || processes::rank() == 0;
}

}  // namespace

void set_level(Level level) {
  state().level = level;
}
Level level() {
  return state().level;
}
void set_sink(std::function<void(Level, std::string_view)> sink) {
  state().sink = std::move(sink);
}
std::vector<std::string> warnings() {
  return state().warnings;
}
void clear_warnings() {
  state().warnings.clear();
}

void message(Level level, std::string_view text) {
  Log& log = state();
  // A warning is told once; others come as often as they are logged.
  if (level == Level::warn) {
    if (std::find(log.warnings.begin(), log.warnings.end(), text) != log.warnings.end()) return;
    log.warnings.emplace_back(text);
  }
  // Below the level nothing is printed; a warning has been collected all the same.
  if (level < log.level || !first_process()) return;
  if (log.sink) {
    log.sink(level, text);
    return;
  }
  const auto severity = level == Level::debug  ? spdlog::level::debug
                        : level == Level::info ? spdlog::level::info
                                               : spdlog::level::warn;
  log.terminal->log(severity, "{}", printable(std::string(text)));
}

}  // namespace solidus::logging
