#!/usr/bin/env bash
# The path of somebody who meets Solidus on a bare Debian, each step timed: bare_debian.sh RELEASE FOLDER [--without-tests]
#
# RELEASE is bookworm (Debian 12) or trixie (13); as root. FOLDER becomes a bare root made by debootstrap, with a clone of the commit that
# is checked out here. There both commands of the README run, then two processes, a restart, `solidus new` on three parts, the Debian
# packages, and what an ordinary user does with them: a case, its page and pictures, Python, a notebook that Jupyter executes.
#
# For each step a line of FOLDER/table.md says processor time and clock, or that it failed, with the end of its output in FOLDER/log; the
# steps after it run nevertheless. The exit code is 1 where one failed. FOLDER/home/ann and FOLDER/root/solidus/results hold what was
# written: open the pages in a browser and look at them. --without-tests leaves out `./dev test`, which takes most of the time.
set -euo pipefail
usage() { sed -n '2s/^# //p' "${BASH_SOURCE[0]}" >&2; exit 2; }
release=${1:-} root=${2:-} tests=${3:-}
case $release in bookworm | trixie) ;; *) usage ;; esac
[[ -n $root && ($tests == "" || $tests == --without-tests) ]] || usage
((EUID == 0)) || { echo "bare_debian.sh: debootstrap and chroot need root" >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "bare_debian.sh: debootstrap is not installed" >&2; exit 1; }
[[ ! -e $root ]] || { echo "bare_debian.sh: $root is there already" >&2; exit 1; }
sources=$(git -C "$(dirname "${BASH_SOURCE[0]}")" rev-parse --show-toplevel)
mkdir -p "$root"
root=$(realpath "$root")
failed=0

leave() { umount -R "$root/proc" "$root/dev" 2>/dev/null || true; }
trap leave EXIT

note() { printf '%s\n' "$*" | tee -a "$root/table.md"; }

# Runs a command of the host, named in the table: what the step is called, then its command.
timed() {
  local name=$1 file="$root/log/${1//[^a-zA-Z0-9]/_}.txt" user system clock TIMEFORMAT='%U %S %R'
  shift
  if { time "$@" >"$file" 2>&1 </dev/null; } 2>"$root/log/time"; then
    read -r user system clock < <(tail -1 "$root/log/time")
    note "$(awk -v name="$name" -v u="$user" -v s="$system" -v c="$clock" \
      'BEGIN { printf "| %s | %.1f s | %.1f s |", name, u + s, c }')"
  else
    failed=1
    note "| $name | failed | |"
    tail -20 "$file" >&2
  fi
}

# What the step is called, then its command, in the new root as root, from the clone.
step() {
  local name=$1
  shift
  timed "$name" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
    chroot "$root" /bin/bash -ec "cd /root/solidus && $*"
}
as_user() {
  local name=$1
  shift
  step "$name" "su - ann -c '$*'"
}

mkdir "$root/log"
note "| $release | processor time | clock |"
note "|---|---|---|"
timed "debootstrap" debootstrap --variant=minbase "$release" "$root" http://deb.debian.org/debian
cp /etc/resolv.conf "$root/etc/"
mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"
mount --make-rslave "$root/dev"
git clone -q "$sources" "$root/root/solidus"

step "./dev run cases/aluminium_cylinder" "./dev run cases/aluminium_cylinder"
note "| pictures of it: $(find "$root/root/solidus/results" -name '*.png' | wc -l) | | |"
note "| packages: $(chroot "$root" dpkg-query -W | wc -l) | | |"
step "hot_spots on two processes" "NP=2 ./dev run cases/hot_spots"
step "5 s of aluminium_cylinder" "build/release/solidus run cases/aluminium_cylinder -o results/restarted --set time.end=\"5 s\""
step "restart of it, to 10 s" "build/release/solidus run cases/aluminium_cylinder -o results/restarted --set time.end=\"10 s\" --restart"
for part in flange hook stepped_plate; do
  step "new $part.step, run --heat-only" "mkdir results/$part && cd results/$part && ../../build/release/solidus new \
    ../../tests/parts/$part.step --alloy aluminium_alsi7mg -o case && ../../build/release/solidus run --heat-only case -o out"
done
step "./dev package" ./dev package
step "apt install of the package" "apt-get install -y -q --no-install-recommends ./build/portable/packages/solidus_*_amd64.deb python3-numpy \
  python3-matplotlib openmpi-bin"
step "apt install of Jupyter" "apt-get install -y -q --no-install-recommends jupyter-nbconvert python3-ipykernel"
step "an ordinary user" "useradd -m -s /bin/bash ann"
as_user "run --report hot_spots" "cp -r /usr/share/solidus/cases/hot_spots . && solidus run --report hot_spots"
as_user "plot of hot_spots" "solidus plot results/hot_spots/default"
as_user "hot_spots on two processes, from the package" "mpirun --oversubscribe -n 2 solidus run hot_spots -o two"
as_user "new bracket.step" "cp /usr/share/solidus/cases/bracket_from_step/bracket.step . && solidus new bracket.step --alloy aluminium_alsi7mg"
as_user "run --heat-only bracket" "solidus run --heat-only bracket"
as_user "report of it" "solidus report results/bracket/default"
as_user "the same run from Python" \
  'python3 -c "import solidus_casting as sc; assert sc.has_core(); sc.run(sc.Case.load(\"bracket\"), \"python\", physics=\"heat\")"'
as_user "notebook of hot_spots, by Jupyter" "cd hot_spots && jupyter nbconvert --to html --execute notebook.ipynb"
as_user "notebook of a material point, by Jupyter" \
  "cp -r /usr/share/solidus/cases/point . && cd point && jupyter nbconvert --to html --execute notebook.ipynb"
if [[ -z $tests ]]; then
  step "./dev test" ./dev test
  log=$root/log/__dev_test.txt
  note "| $(grep -h 'tests passed' "$log" || echo 'the tests did not run') | | |"
  while read -r reason; do note "| $reason | | |"; done < <(sed -n 's/^==> skipped: /skipped: /p' "$log")
fi
exit "$failed"
