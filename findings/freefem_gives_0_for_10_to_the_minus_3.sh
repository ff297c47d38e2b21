#!/usr/bin/env bash
# What:      FreeFEM takes a power of two whole numbers for a whole number: 10^-3 is 0, and 34*10^-3 is 0, as 1/2 is. 10.^-3 and 1e-3 are
#            0.001. A variable of type "real" does not change that.
# Versions:  FreeFEM 4.15 (Debian 13)
# Seen on:   1 December 2026, Debian 12, x86-64
# Matters:   a conductance, a gap or a time in SI units is 0, and the equation is solved without it: no exchange of heat, no message.
# Solidus:   numbers of a case are those of TOML, 1e-3; none is a whole number by how it is written.
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root trixie freefem++=4.15+dfsg-1
environment=(UCX_LOG_LEVEL=fatal OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)

cat >"$root/tmp/powers.edp" <<'EDP'
real a = 10^-3, b = 34*10^-3, c = 10.^-3, d = 34*1e-3;
cout << "10^-3 = " << a << ", 34*10^-3 = " << b << ", 10.^-3 = " << c << ", 34*1e-3 = " << d << endl;
// A wall of 10 mm that is held at 100 on the left and loses heat on the right, to 20, with h/k = 4000, written in two ways.
mesh wall = square(10, 2, [0.01*x, 0.01*y]);
fespace Space(wall, P1);
Space T, v;
for (int way = 0; way < 2; way++) {
  real h = way ? 4000. : 4*(10^-3)*1e6;
  solve heat(T, v) = int2d(wall)(dx(T)*dx(v) + dy(T)*dy(v)) + int1d(wall, 2)(h*T*v) - int1d(wall, 2)(h*20*v) + on(4, T=100);
  cout << "h = " << h << ": T on the right = " << T(0.01, 0.005) << endl;
}
EDP
expect "$(inside FreeFem++-nw -v 0 /tmp/powers.edp)" <<END
10^-3 = 0, 34*10^-3 = 0, 10.^-3 = 0.001, 34*1e-3 = 0.034
h = 0: T on the right = 100
h = 4000: T on the right = 21.9512
END
