#!/usr/bin/env bash
# What:      OMPI_MCA_rmaps_base_oversubscribe=1, with which mpirun of Open MPI 4 starts more processes than there are slots, is passed over
#            by Open MPI 5 without a word: what starts processes there is PRRTE, which reads PRTE_MCA_rmaps_default_mapping_policy.
# Versions:  Open MPI 4.1.4 (Debian 12), Open MPI 5.0.7 (Debian 13)
# Seen on:   29 November 2026, Debian 12, x86-64
# Matters:   A batch file or a container that sets it starts nothing any more: "There are not enough slots available". Neither version
#            reads the other's name, so that a script for both sets both, or says mpirun --oversubscribe.
# Solidus:   sets both for its tests (tests/CMakeLists.txt) and says --oversubscribe elsewhere (dev).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

# Whether mpirun starts two processes where one slot is.
started() {
  local name=$1 said
  environment=(OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "$name")
  said=$(inside mpirun.openmpi --host localhost:1 -n 2 echo started 2>&1 | tr -d '\0') || true
  case $said in
    *'not enough slots'*) echo "$version $name: not enough slots" ;;
    *$'started\nstarted'*) echo "$version $name: started" ;;
    *) echo "$version $name: $said" ;;
  esac
}

both() {
  local version=$1
  started OMPI_MCA_rmaps_base_oversubscribe=1
  started PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe
}

make_root bookworm openmpi-bin=4.1.4-3+b1 coreutils=9.1-1
four=$(both 4.1.4)
make_root trixie openmpi-bin=5.0.7-1 coreutils=9.7-3
expect "$four
$(both 5.0.7)" <<END
4.1.4 OMPI_MCA_rmaps_base_oversubscribe=1: started
4.1.4 PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe: not enough slots
5.0.7 OMPI_MCA_rmaps_base_oversubscribe=1: not enough slots
5.0.7 PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe: started
END
