/// Messages of the library: printed by process 0 only, warnings also kept for summary.json.
///
/// The namespace is not called log: that is the logarithm of lanes (numbers/simd.hpp).
///
/// Used sparingly: a law or a kernel never logs. Call it on every process alike; what other processes than 0
/// say is dropped.
#pragma once

#include <fmt/format.h>

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace solidus::logging {

enum class Level { debug, info, warn, silent };

/// Messages below this level are not printed; the default is `info`. Warnings are collected whatever the
/// level.
void set_level(Level level);
Level level();

/// Redirects printed lines from the terminal to a function (of a test or a graphical program); an empty
/// function restores the terminal (stderr, so that stdout carries only what the user asked for).
void set_sink(std::function<void(Level, std::string_view)> sink);

/// The different warnings so far, in the order in which they first came.
std::vector<std::string> warnings();
void clear_warnings();

/// Prints and, for a warning, collects `text`. A warning that was given before is not repeated.
void message(Level level, std::string_view text);

template <class... Args>
void debug(fmt::format_string<Args...> format, Args&&... args) {
  if (level() <= Level::debug) message(Level::debug, fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void info(fmt::format_string<Args...> format, Args&&... args) {
  if (level() <= Level::info) message(Level::info, fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void warn(fmt::format_string<Args...> format, Args&&... args) {
  message(Level::warn, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace solidus::logging
