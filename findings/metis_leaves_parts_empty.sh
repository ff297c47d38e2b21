#!/usr/bin/env bash
# What:      METIS divides a small mesh into fewer parts than asked for and reports success: of nine hexahedra in seven parts all go to one,
#            six are empty. 27 hexahedra in nine parts leave two empty.
# Versions:  METIS 5.1.0 (Debian 12)
# Seen on:   28 November 2026, Debian 12, x86-64
# Matters:   a process without elements has matrices without rows; whether a solver takes that is found out on a coarse mesh.
# Solidus:   gives a node to every process that METIS left without one (src/mesh/parts/partition.cpp).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root bookworm metis=5.1.0.dfsg-7

# A block of x times y times z cubes.
block() {
  echo $(($1 * $2 * $3))
  for ((k = 0; k < $3; ++k)); do for ((j = 0; j < $2; ++j)); do for ((i = 0; i < $1; ++i)); do
    local a=$((1 + i + ($1 + 1) * (j + ($2 + 1) * k))) across=$(($1 + 1)) up=$((($1 + 1) * ($2 + 1)))
    local b=$((a + 1)) c=$((a + 1 + across)) d=$((a + across))
    echo $a $b $c $d $((a + up)) $((b + up)) $((c + up)) $((d + up))
  done; done; done
}
divide() {
  block "${@:2}" >"$root/tmp/block.mesh"
  inside mpmetis -gtype=dual /tmp/block.mesh "$1" >/dev/null &&
    echo "exit code 0, $(sort -u "$root/tmp/block.mesh.epart.$1" | wc -l) of $1 parts"
}
expect "$(divide 7 3 3 1; divide 9 3 3 3; divide 8 3 3 3)" <<END
exit code 0, 1 of 7 parts
exit code 0, 7 of 9 parts
exit code 0, 8 of 8 parts
END
