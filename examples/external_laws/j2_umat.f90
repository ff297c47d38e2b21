! A UMAT: J2 plasticity with linear isotropic hardening whose moduli and flow stress fall with temperature.
!
!   gfortran -O2 -shared -fPIC -o libj2_umat.so j2_umat.f90
!
! PROPS: E, nu, flow stress, hardening slope at 20 degC [Pa], and how they fall per kelvin: E, flow stress.
! STATEV: the six elastic strains (engineering shears), the equivalent plastic strain.
! DDSDDE is the consistent tangent; SSE, SPD are the energies that it stores and dissipates.
subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, &
                temp, dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, &
                celent, dfgrd0, dfgrd1, noel, npt, layer, kspt, jstep, kinc)
  implicit none
  integer, parameter :: dp = kind(1d0)
  character(len=80) :: cmname
  integer :: ndi, nshr, ntens, nstatv, nprops, noel, npt, layer, kspt, jstep(4), kinc
  real(dp) :: stress(ntens), statev(nstatv), ddsdde(ntens, ntens), sse, spd, scd, rpl, ddsddt(ntens), &
              drplde(ntens), drpldt, stran(ntens), dstran(ntens), time(2), dtime, temp, dtemp, predef(1), dpred(1), &
              props(nprops), coords(3), drot(3, 3), pnewdt, celent, dfgrd0(3, 3), dfgrd1(3, 3)
  real(dp) :: warmer, young, nu, shear, bulk, yield, slope, elastic(6), s(6), n(6), p, q, dgamma, norm, theta, &
              theta_bar, factor
  integer :: i, j

  warmer = temp + dtemp - 293.15_dp
  young = props(1) * (1 - props(5) * warmer)
  nu = props(2)
  shear = young / (2 * (1 + nu))
  bulk = young / (3 * (1 - 2 * nu))
  yield = props(3) * (1 - props(6) * warmer)
  slope = props(4)

  elastic = statev(1:6) + dstran
  p = sum(elastic(1:3))
  do i = 1, 3
    s(i) = 2 * shear * (elastic(i) - p / 3)
  end do
  s(4:6) = shear * elastic(4:6)
  norm = sqrt(sum(s(1:3)**2) + 2 * sum(s(4:6)**2))
  q = sqrt(1.5_dp) * norm
  n = 0
  if (norm > 0) n = s / norm
  dgamma = 0
  theta = 1
  theta_bar = 0
  if (q > yield + slope * statev(7)) then
    dgamma = (q - yield - slope * statev(7)) / (3 * shear + slope)
    theta = 1 - 3 * shear * dgamma / q
    theta_bar = 1 / (1 + slope / (3 * shear)) - (1 - theta)
  end if

  do i = 1, 6
    factor = merge(1d0, 2d0, i <= 3)
    statev(i) = elastic(i) - factor * sqrt(1.5_dp) * dgamma * n(i)
  end do
  statev(7) = statev(7) + dgamma
  stress(1:3) = theta * s(1:3) + bulk * p
  stress(4:6) = theta * s(4:6)

  ddsdde = 0
  ddsdde(1:3, 1:3) = bulk - 2 * shear * theta / 3
  do i = 1, 3
    ddsdde(i, i) = ddsdde(i, i) + 2 * shear * theta
    ddsdde(i + 3, i + 3) = shear * theta
  end do
  if (dgamma > 0) then
    do j = 1, 6
      do i = 1, 6
        ddsdde(i, j) = ddsdde(i, j) - 2 * shear * theta_bar * n(i) * n(j)
      end do
    end do
  end if

  sse = bulk * p**2 / 2 + theta**2 * norm**2 / (4 * shear)
  spd = spd + yield * dgamma
end subroutine umat
