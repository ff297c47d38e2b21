#!/usr/bin/env bash
# The path of somebody who meets the package on a bare Debian 12, each step timed: bare_debian.sh PACKAGE.deb FOLDER [BARE]
#
# As root. FOLDER becomes a bare root made by debootstrap, or a copy of the folder BARE that already is one. There the package is
# installed, an ordinary user runs an installed case and a part that `solidus new` makes, writes their pages, and does the same from
# Python and from notebooks that Jupyter executes. For each step a line says processor time and clock. FOLDER/home/ann holds what was
# written: open the pages (results/*/report.html, *.html) in a browser and look at them. Then: umount -R FOLDER/proc FOLDER/dev.
set -euo pipefail
package=$(realpath "$1") root=$2 bare=${3:-}
log=$(mktemp)

# What the step is called, then its command, in the new root; the rest of its output goes to a file that is shown where it fails.
step() {
  local name=$1 user system clock
  shift
  /usr/bin/time -o "$log.time" -f '%U %S %e' env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C DEBIAN_FRONTEND=noninteractive \
    chroot "$root" /bin/bash -ec "$*" >"$log" 2>&1 || { cat "$log"; echo "$name failed" >&2; exit 1; }
  read -r user system clock < <(tail -1 "$log.time")
  awk -v name="$name" -v cpu="$user + $system" -v u="$user" -v s="$system" -v c="$clock" \
    'BEGIN { printf "%-60s %6.1f s of processor time %7.1f s of the clock\n", name, u + s, c }'
}
as_user() {
  local name=$1
  shift
  step "$name" "su - ann -c '$*'"
}

if [[ -n $bare ]]; then cp -a "$bare" "$root"; else debootstrap --variant=minbase bookworm "$root" http://deb.debian.org/debian >/dev/null; fi
cp /etc/resolv.conf "$root/etc/"
mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"
mount --make-rslave "$root/dev"
cp "$package" "$root/root/solidus.deb"
step "apt-get update" apt-get update -q
step "apt install of the package" "apt-get install -y /root/solidus.deb"
step "apt install of Jupyter" "apt-get install -y --no-install-recommends jupyter-nbconvert python3-ipykernel"
step "an ordinary user" "useradd -m -s /bin/bash ann"
as_user "run hot_spots" "cp -r /usr/share/solidus/cases/hot_spots . && solidus run hot_spots"
as_user "report of it" "solidus report results/hot_spots/default"
as_user "run aluminium_cylinder --report" "cp -r /usr/share/solidus/cases/aluminium_cylinder . && solidus run --report aluminium_cylinder"
as_user "plot of hot_spots" "solidus plot results/hot_spots/default"
as_user "hot_spots on two processes" "mpirun --oversubscribe -n 2 solidus run hot_spots -o two"
as_user "new bracket.step" "cp /usr/share/solidus/cases/bracket_from_step/bracket.step . && solidus new bracket.step --alloy aluminium_alsi7mg"
as_user "run --heat-only bracket" "solidus run --heat-only bracket"
as_user "report of it" "solidus report results/bracket/default"
as_user "the same run from Python" 'python3 -c "import solidus_casting as sc; assert sc.has_core(); sc.run(sc.Case.load(\"bracket\"), \"python\", physics=\"heat\")"'
as_user "notebook of hot_spots, by Jupyter" "cd hot_spots && jupyter nbconvert --to html --execute notebook.ipynb"
as_user "notebook of a material point, by Jupyter" "cp -r /usr/share/solidus/cases/point . && cd point && jupyter nbconvert --to html --execute notebook.ipynb"
rm -f "$log" "$log.time"
