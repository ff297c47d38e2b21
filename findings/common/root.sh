# shellcheck shell=bash
# What the scripts of this folder share: packages of a release of Debian, at the versions named, in a temporary root of their own, and
# packages of npm in a temporary folder.
# To be sourced; see README.md. Nothing of the system is changed, and nothing of it is seen by what runs in the root.
set -euo pipefail

environment=() python_path=  # of what runs inside

work=$(mktemp -d "${TMPDIR:-/tmp}/finding.XXXXXX")
trap 'rm -rf "$work"' EXIT
mirror=${SOLIDUS_DEBIAN_MIRROR:-http://deb.debian.org/debian}
cache=$(realpath -m "${SOLIDUS_FINDINGS_CACHE:-$work/cache}")  # of packages; ./dev findings has one for all scripts
keyring=/usr/share/keyrings/debian-archive-keyring.gpg

# Exit code 77: nothing was found out.
skip() { printf 'skipped: %s\n' "$*"; exit 77; }

# apt_of SUITE ARGUMENT...: apt-get that knows nothing but this release of Debian and takes no package for installed.
apt_of() {
  local at="$cache/$1"
  apt-get -qq -y -o Dir::Etc::SourceList="$at/sources.list" -o Dir::Etc::SourceParts=/dev/null \
    -o Dir::Etc::Preferences=/dev/null -o Dir::Etc::PreferencesParts=/dev/null -o Dir::State="$at/state" \
    -o Dir::State::status="$at/state/status" -o Dir::Cache="$at" -o APT::Install-Recommends=false \
    -o Acquire::Languages=none -o APT::Sandbox::User= -o Debug::NoLocking=1 "${@:2}" 2>"$work/apt.log"
}

# download SUITE PACKAGE=VERSION...: fetches the packages and what they depend on; $packages are the files.
download() {
  local suite=$1 at="$cache/$1" simulated
  shift
  if [[ ! -e $at/sources.list ]]; then
    mkdir -p "$at"/{archives,lists,state/lists}/partial
    : >"$at/state/status"
    echo "deb [signed-by=$keyring] $mirror $suite main" >"$at/sources.list"
    if ! apt_of "$suite" -o APT::Update::Error-Mode=any update; then
      rm "$at/sources.list"
      skip "no lists of $suite from $mirror: $(tail -n 1 "$work/apt.log")"
    fi
  fi
  simulated=$(apt_of "$suite" -q=1 --simulate install libc-bin "$@") ||
    skip "$suite no longer has $*: $(tail -n 1 "$work/apt.log")"
  apt_of "$suite" --download-only install libc-bin "$@" || skip "cannot be downloaded: $*: $(tail -n 1 "$work/apt.log")"
  # "Inst NAME (VERSION RELEASE [ARCHITECTURE]) ..." is NAME_VERSION_ARCHITECTURE.deb
  mapfile -t packages < <(
    sed -nE 's/^Inst ([^ ]+) \(([^ ]+) .*\[([a-z0-9]+)\]\).*/\1_\2_\3.deb/p' <<<"$simulated" | sed "s/:/%3a/; s|^|$at/archives/|"
  )
}

# make_root SUITE PACKAGE=VERSION...: unpacks the packages and what they depend on into a new $root. Their scripts of installation
# are not run: what Debian's alternatives would choose is found along LD_LIBRARY_PATH (inside).
make_root() {
  local tool folder package
  [[ $(uname -m) == x86_64 ]] || skip "the versions are those of x86-64"
  for tool in apt-get dpkg-deb chroot; do command -v $tool >/dev/null || skip "there is no $tool"; done
  ((EUID == 0)) || unshare --map-root-user true 2>/dev/null || skip "neither root nor a namespace of users is to be had"
  [[ -e $keyring ]] || skip "the keys of Debian's archive are missing (package debian-archive-keyring)"
  download "$@"
  root=$(mktemp -d "$work/root.XXXXXX")
  mkdir -p "$root"/usr/{bin,sbin,lib,lib64} "$root"/{tmp,dev,proc,etc,root}
  for folder in bin sbin lib lib64; do ln -s "usr/$folder" "$root/$folder"; done
  for package in "${packages[@]}"; do
    dpkg-deb --fsys-tarfile "$package" | tar -x --no-same-owner --keep-directory-symlink -C "$root"
  done
  mknod -m 666 "$root/dev/null" c 1 3 2>/dev/null || : >"$root/dev/null"
  echo "root:x:0:0:root:/root:/bin/sh" >"$root/etc/passwd"
  inside ldconfig
  printf '%s: %s\n' "$1" "${*:2}"
}

# inside PROGRAM ARGUMENT...: runs it in the root, as on a bare machine, with one thread.
inside() {
  local enter=(chroot) libraries=/usr/lib/x86_64-linux-gnu
  ((EUID == 0)) || enter=(unshare --map-root-user chroot)
  env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 OMP_NUM_THREADS=1 PYTHONPATH="$python_path" \
    "${environment[@]}" \
    LD_LIBRARY_PATH="$libraries/openblas-serial:$libraries/blas:$libraries/lapack" "$(command -v "${enter[0]}")" \
    "${enter[@]:1}" "$root" "$@"
}

# make_modules NAME=VERSION...: installs these packages of npm with their dependencies into a new folder, $modules. Their scripts of
# installation are not run. Node.js is that of the machine.
make_modules() {
  local tool
  for tool in node npm; do command -v $tool >/dev/null || skip "there is no $tool"; done
  (($(node -p 'process.versions.node.split(".")[0]') >= 18)) || skip "Node.js is older than 18"
  modules=$(mktemp -d "$work/modules.XXXXXX")
  echo '{"private": true}' >"$modules/package.json"
  npm install --prefix "$modules" --cache "$cache/npm" --ignore-scripts --no-audit --no-fund "${@/=/@}" >"$work/npm.log" 2>&1 ||
    skip "cannot be had from npm: $*: $(grep -m 1 'npm error' "$work/npm.log" || tail -n 1 "$work/npm.log")"
  printf 'npm: %s\n' "$*"
}

# in_node ARGUMENT...: runs the module of standard input beside $modules, with nothing of the environment.
in_node() { (cd "$modules" && env -i PATH="$PATH" HOME="$modules" LC_ALL=C.UTF-8 node --input-type=module - "$@"); }

# expect SAID: compares it with what the script states (standard input), ends with exit code 1 where they differ.
expect() {
  local stated
  stated=$(cat)
  if [[ $1 == "$stated" ]]; then
    printf '%s\n' "$1"
    return
  fi
  printf 'It behaves otherwise than stated (<: stated, >: seen):\n'
  diff <(printf '%s\n' "$stated") <(printf '%s\n' "$1") || true
  exit 1
}
