/// The program that this library belongs to: its own file, unless a host program (an interpreter) has
/// another.
#pragma once

#include <filesystem>

namespace solidus {

/// Returns the full path of the program `solidus`, which its data are found from and which reads meshes in
/// processes of its own. By default the program of this process, or what a loader that was started by hand
/// was told to call it (`ld.so --argv0 NAME PROGRAM`): so do the launchers of an archive.
std::filesystem::path program_path();

/// Names the program for a process that is not the program itself. Call it before anything else.
void set_program_path(std::filesystem::path program);

}  // namespace solidus
