#!/bin/sh
# Starts the program of this name that the archive brings, with the archive's own C library and loader: nothing of the system but its
# kernel is needed, and nothing of what is set here reaches other programs. The archive may lie anywhere and be moved.
here=$(dirname "$(readlink -f "$0")")
root=${here%/@PLACE@}
name=${0##*/}
loader=$root/lib/solidus/ld-linux-x86-64.so.2
program=$root/libexec/solidus/programs/@NAME@

if ! "$loader" --verify "$program" 2>/dev/null; then
  echo "$name: this machine ($(uname -srm)) cannot start $program: the archive is for Linux from 3.2 on with x86-64, and must lie whole in a folder that is not mounted with noexec" >&2
  exit 1
fi
if [ -n "$OMPI_COMM_WORLD_SIZE" ] && [ "$OPAL_PREFIX" != "$root/lib/openmpi" ]; then
  echo "$name: this mpirun is not the one that the archive brings: start it with $root/bin/mpirun" >&2
  exit 1
fi

if [ @NAME@ = mpirun ] && ! [ -w "${TMPDIR:-/tmp}" ]; then
  echo "$name: '${TMPDIR:-/tmp}' cannot be written, where processes find each other: TMPDIR=FOLDER names another folder" >&2
  exit 1
fi

# Open MPI, PMIx and UDUNITS-2 look for their files in the folders they were built for, unless they are told.
export OPAL_PREFIX="$root/lib/openmpi" OPAL_PKGLIBDIR="$root/lib/openmpi/plugins" OPAL_PKGDATADIR="$root/lib/openmpi/texts"
export OPAL_SYSCONFDIR="$root/lib/openmpi/settings" PMIX_PREFIX="$root/lib/pmix" PMIX_PKGLIBDIR="$root/lib/pmix"
export UDUNITS2_XML_PATH="$root/share/udunits/udunits2.xml"
exec "$loader" --inhibit-cache --library-path "$root/lib/solidus" --argv0 "$here/@NAME@" "$program" "$@"
