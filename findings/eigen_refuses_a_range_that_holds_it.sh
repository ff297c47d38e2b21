#!/usr/bin/env bash
# What:      find_package(Eigen3 3.4...5) finds no Eigen 3.4.0: the file by which the package tells its version, which CMake writes for
#            COMPATIBILITY SameMajorVersion, refuses every range that ends in another major version, also one that holds it.
# Versions:  Eigen 3.4.0, CMake 3.25.1
# Seen on:   29 November 2026, Debian 12, x86-64
# Matters:   Eigen 5 follows on 3.4 and is found by the same name, so that a range is the natural way to ask for either.
# Solidus:   asks for any version and compares it itself (cmake/dependencies.cmake).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root bookworm cmake=3.25.1-1 make=4.3-4.1 libeigen3-dev=3.4.0-4

mkdir "$root/project"
cat >"$root/project/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.25)
project(ask NONE)
foreach(wanted 3.4 "3.4...<4" 3.4...5 3.3...5)
  unset(Eigen3_DIR CACHE)
  find_package(Eigen3 ${wanted} NO_MODULE QUIET)
  message(STATUS "asked for ${wanted}: found ${Eigen3_FOUND}, looked at ${Eigen3_CONSIDERED_VERSIONS}")
endforeach()
CMAKE

expect "$(inside cmake -S /project -B /project/build | grep asked)" <<END
-- asked for 3.4: found 1, looked at 3.4.0
-- asked for 3.4...<4: found 1, looked at 3.4.0
-- asked for 3.4...5: found 0, looked at 3.4.0
-- asked for 3.3...5: found 0, looked at 3.4.0
END
