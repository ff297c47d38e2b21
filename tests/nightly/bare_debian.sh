#!/usr/bin/env bash
# The path of somebody who meets Solidus on a bare Debian, each step timed: bare_debian.sh RELEASE FOLDER [--from OTHER] [PART ...]
#
# RELEASE is bookworm (Debian 12), trixie (13) or testing; as root. FOLDER becomes a bare root, in which the commit that is checked out
# here takes these parts, all of them where none is named:
#   root        debootstrap makes the root (not again where it is there), with a clone of the sources
#   first       the README's first command: packages, build, run, page and pictures; an earlier build and its cache are removed
#   processes   a case on two processes
#   restart     a run that stops and goes on; with --from OTHER, a folder of another release, from the checkpoint that was written there
#   new         `solidus new` and a run of its case, for three parts
#   packages    the Debian packages are made and installed
#   user        an ordinary user with what the packages bring: cases, pages, pictures, Python
#   notebooks   two notebooks that Jupyter executes for that user
#   tests       the README's second command
#
# FOLDER/walk/table.md has a line for each step: processor time and clock, or that it failed; the steps after it run nevertheless.
# FOLDER/walk/*.txt is what each said, FOLDER/walk/facts what was measured: bare_debian_table.py FOLDER... makes one table of several
# releases. A part that runs again replaces its lines. The exit code is 1 where a step failed. FOLDER/home/ann and
# FOLDER/root/solidus/results hold what was written: open the pages in a browser and look at them.
set -euo pipefail
fail() { printf 'bare_debian.sh: %s\n' "$*" >&2; exit 1; }
usage() { sed -n '2s/^.*: bare/usage: bare/p' "${BASH_SOURCE[0]}" >&2; exit 2; }

all_parts=(root first processes restart new packages user notebooks tests)
release=${1:-} root=${2:-}
case $release in bookworm | trixie | testing) ;; *) usage ;; esac
[[ -n $root ]] || usage
shift 2
other='' parts=()
while (($#)); do
  case " ${all_parts[*]} " in
    *" $1 "*) parts+=("$1") ;;
    *)
      [[ $1 == --from && -n ${2:-} ]] || usage
      other=$(realpath "$2")
      shift
      ;;
  esac
  shift
done
((${#parts[@]})) || parts=("${all_parts[@]}")
((EUID == 0)) || fail "debootstrap and chroot need root"
mkdir -p "$root"
root=$(realpath "$root")

# In a namespace of its own, whatever is mounted into the root is gone when the script ends, however it ends.
if [[ ${BARE_DEBIAN_NAMESPACE:-} != "$root" ]]; then
  BARE_DEBIAN_NAMESPACE=$root exec unshare --mount "$BASH" "${BASH_SOURCE[0]}" "$release" "$root" ${other:+--from "$other"} "${parts[@]}"
fi
sources=$(git -C "$(dirname "${BASH_SOURCE[0]}")" rev-parse --show-toplevel)
steps=$root/walk/steps facts=$root/walk/facts
failed=0

# replace FILE KEY VALUE...: the line of FILE that begins with KEY, in its place, or a new one at the end; columns are parted by tabs.
replace() {
  local file=$1 line
  shift
  line=$(printf '%s\t' "$@")
  touch "$file"
  LINE=${line%$'\t'} awk -F '\t' -v key="$1" '$1 == key { $0 = ENVIRON["LINE"]; there = 1 } { print }
    END { if (!there) print ENVIRON["LINE"] }' "$file" >"$file.new"
  mv "$file.new" "$file"
}

fact() {
  replace "$facts" "$@"
  printf '    %s: %s\n' "$1" "$2"
}

# Runs a command of the host: what the step is called, then the command.
timed() {
  local name=$1 log="$root/walk/${1//[^a-zA-Z0-9]/_}.txt" user system clock TIMEFORMAT='%U %S %R'
  shift
  printf '%s\n' "$name"
  if { time "$@" >"$log" 2>&1 </dev/null; } 2>"$root/walk/time"; then
    read -r user system clock < <(tail -1 "$root/walk/time")
    replace "$steps" "$name" "$(awk -v u="$user" -v s="$system" 'BEGIN { printf "%.1f s", u + s }')" "$(printf '%.1f s' "$clock")"
  else
    failed=1
    replace "$steps" "$name" failed ""
    tail -20 "$log" >&2
    return 1
  fi
}

in_root() {
  env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive TERM=dumb \
    chroot "$root" /bin/bash -ec "cd /root/solidus && $*"
}
# What the step is called, then its command, in the root as root, from the clone. A step that failed is noted, and the next one follows.
step() { timed "$1" in_root "${*:2}" || true; }
as_user() { step "$1" "su - ann -c '${*:2}'"; }

version() { in_root "dpkg-query -W -f '\${Version}' $1 2>/dev/null" | sed -E 's/^[0-9]+://; s/[-+~].*//'; }

part_root() {
  command -v debootstrap >/dev/null || fail "debootstrap is not installed"
  if [[ ! -e $root/etc/debian_version ]]; then
    timed "debootstrap" debootstrap --variant=minbase "$release" "$root" http://deb.debian.org/debian || fail "no root, no walk"
  fi
}

prepare() {
  [[ -e $root/etc/debian_version ]] || fail "there is no root in $root: begin with the part 'root'"
  # shellcheck source=/dev/null
  fact system "$(. "$root/etc/os-release" && echo "$PRETTY_NAME")"
  cp /etc/resolv.conf "$root/etc/"
  mount -t proc proc "$root/proc"
  mount -t sysfs -o ro sysfs "$root/sys"
  mount --rbind /dev "$root/dev"
  if [[ -e $root/root/solidus ]]; then
    git -C "$root/root/solidus" fetch -q "$sources" HEAD
    git -C "$root/root/solidus" checkout -q --force --detach FETCH_HEAD
  else
    git clone -q "$sources" "$root/root/solidus"
  fi
  fact sources "$(git -C "$sources" log -1 --date=format:'%-d %B %Y' --format='%h of %ad')"
}

part_first() {
  local start before pictures
  before=$(in_root "dpkg-query -W | wc -l")
  rm -rf "$root"/root/{solidus/build,solidus/results,.cache/ccache}
  start=$(date +%s)
  timed "./dev run cases/aluminium_cylinder" in_root "./dev run cases/aluminium_cylinder" || return 0
  pictures=$(find "$root/root/solidus/results" -name '*.png' -printf '%T@\n' | sort -n)
  fact "packages before" "$before"
  fact packages "$(in_root "dpkg-query -W | wc -l")"
  fact pictures "$(grep -c . <<<"$pictures" || true)"
  fact "seconds to the first picture" "$(awk -v s="$start" 'NR == 1 { printf "%.0f", $1 - s }' <<<"$pictures")"
  fact "processor seconds of it" "$(awk -F '\t' '$1 == "./dev run cases/aluminium_cylinder" { print $2 + 0 }' "$steps")"
  fact "compiler, CMake" "clang $(version clang), $(version cmake)"
  fact "PETSc, Open MPI, HDF5" "$(version petsc-dev), $(version libopenmpi-dev), $(version libhdf5-openmpi-dev)"
  fact "Gmsh, matplotlib, Eigen" "$(version libgmsh-dev), $(version python3-matplotlib), $(version libeigen3-dev)"
}

part_processes() { step "hot_spots on two processes" "NP=2 ./dev run cases/hot_spots"; }

# Each column of two tables of history, but for the defect of energy, which is rounding, to 1e-7 of its largest value: two releases have
# other compilers and solvers. The shared times are compared.
alike='import csv, sys
def table(path):
    rows = [row for row in csv.reader(open(path)) if row and not row[0].startswith("#")]
    return rows[0], {float(row[0]): row for row in rows[1:]}
(names, one), (_, two) = table(sys.argv[1]), table(sys.argv[2])
times = sorted(set(one) & set(two))
assert len(times) >= 10, f"{len(times)} times are in both tables"
worst = 0.0
for column, name in enumerate(names):
    if "defect" in name: continue
    a, b = ([float(t[time][column]) for time in times] for t in (one, two))
    largest = max(map(abs, a + b))
    if largest > 0: worst = max(worst, max(abs(x - y) for x, y in zip(a, b)) / largest)
print(f"{len(times)} times, {len(names)} columns, worst difference {worst:.1e}")
assert worst < 1e-7'

part_restart() {
  local run="build/release/solidus run cases/aluminium_cylinder --no-progress"
  step "5 s of aluminium_cylinder" "rm -rf results/restarted && $run -o results/restarted --set time.end=\"5 s\""
  rm -rf "$root/root/solidus/results/stopped"
  cp -r "$root/root/solidus/results/restarted" "$root/root/solidus/results/stopped"
  step "restart of it, to 10 s" "$run -o results/restarted --set time.end=\"10 s\" --restart"
  [[ -n $other ]] || return 0
  rm -rf "$root/root/solidus/results/from_other"
  cp -r "$other/root/solidus/results/stopped" "$root/root/solidus/results/from_other"
  step "restart from the checkpoint of the other release, to 10 s" "$run -o results/from_other --set time.end=\"10 s\" --restart &&
    python3 -c '$alike' results/restarted/history.csv results/from_other/history.csv"
}

part_new() {
  local part
  for part in flange hook stepped_plate; do
    step "new $part.step, run --heat-only" "rm -rf results/$part && mkdir -p results/$part && cd results/$part &&
      ../../build/release/solidus new ../../tests/parts/$part.step --alloy aluminium_alsi7mg -o case &&
      ../../build/release/solidus run --heat-only case -o out"
  done
}

part_packages() {
  step "./dev package" ./dev package
  step "apt install of the package" "apt-get install -y -q --no-install-recommends ./build/portable/packages/solidus_*_amd64.deb python3-numpy \
    python3-matplotlib openmpi-bin"
}

part_user() {
  step "an ordinary user" "id ann >/dev/null 2>&1 || useradd -m -s /bin/bash ann"
  as_user "run --report hot_spots" "cp -r /usr/share/solidus/cases/hot_spots . && solidus run --report hot_spots"
  as_user "plot of hot_spots" "solidus plot results/hot_spots/default"
  as_user "hot_spots on two processes, from the package" "mpirun --oversubscribe -n 2 solidus run hot_spots -o two"
  as_user "new bracket.step" "cp /usr/share/solidus/cases/bracket_from_step/bracket.step . && rm -rf bracket &&
    solidus new bracket.step --alloy aluminium_alsi7mg"
  as_user "run --heat-only bracket" "solidus run --heat-only bracket"
  as_user "report of it" "solidus report results/bracket/default"
  as_user "the same run from Python" \
    'python3 -c "import solidus_casting as sc; assert sc.has_core(); sc.run(sc.Case.load(\"bracket\"), \"python\", physics=\"heat\")"'
}

part_notebooks() {
  step "apt install of Jupyter" "apt-get install -y -q --no-install-recommends jupyter-nbconvert python3-ipykernel"
  as_user "notebook of hot_spots, by Jupyter" "cd hot_spots && jupyter nbconvert --to html --execute notebook.ipynb"
  as_user "notebook of a material point, by Jupyter" \
    "cp -r /usr/share/solidus/cases/point . && cd point && jupyter nbconvert --to html --execute notebook.ipynb"
}

part_tests() {
  local log="$root/walk/__dev_test.txt"
  step "./dev test" ./dev test
  fact "tests passed" "$(grep -cE '^ *[0-9]+/[0-9]+ Test .* Passed ' "$log" || true)"
  fact "tests skipped" "$(grep -cE '^ *[0-9]+/[0-9]+ Test .*\*\*\*Skipped ' "$log" || true)"
  fact "tests failed" "$(grep -cE '^ *[0-9]+/[0-9]+ Test .*\*\*\*(Failed|Timeout|Exception)' "$log" || true)"
  fact "why skipped" "$(sed -n 's/^==> skipped: //p' "$log" | paste -sd ';' | sed 's/;/; /g')"
}

mkdir -p "$root/walk"
prepared=''
for part in "${parts[@]}"; do
  if [[ $part != root && -z $prepared ]]; then
    prepare
    prepared=yes
  fi
  "part_$part"
done
{
  printf '| %s | processor time | clock |\n|---|---|---|\n' "$(sed -n 's/^system\t//p' "$facts" 2>/dev/null)"
  awk -F '\t' '{ printf "| %s | %s | %s |\n", $1, $2, $3 }' "$steps"
} >"$root/walk/table.md"
cat "$root/walk/table.md"
exit "$failed"
