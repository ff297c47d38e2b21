#!/usr/bin/env bash
# What:      A case of OpenFOAM 1912 with any entry in `functions` of system/controlDict runs with Debian 12's package and ends before its
#            first step with Debian 13's, which is the same version, built by a newer gcc: FOAM FATAL IO ERROR, error in IOstream "sha1".
#            The solver takes a digest of the dictionary of functions. Without functions the same case runs in both.
# Versions:  OpenFOAM 1912.200626-1+b1 (Debian 12) and 1912.200626-3+b1 (Debian 13)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   probes, averages, flow rates and residuals that a case writes are functions: what is tried in one release stops in the other.
# Solidus:   writes no functions into the cases of `solidus fill`; means over time are its own (python/solidus_plots).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

# A duct of eight cubes with one step of icoFoam; $1 is the text of `functions`.
flow() {
  local at=$root/tmp/duct
  rm -rf "$at" && mkdir -p "$at"/{0,system,constant}
  head_of() { printf 'FoamFile { version 2.0; format ascii; class %s; object %s; }\n' "$1" "$2"; }
  { head_of dictionary blockMeshDict
    cat <<'END'
vertices ((0 0 0) (1 0 0) (1 1 0) (0 1 0) (0 0 1) (1 0 1) (1 1 1) (0 1 1));
blocks (hex (0 1 2 3 4 5 6 7) (2 2 2) simpleGrading (1 1 1));
edges ();
boundary
(
  inlet { type patch; faces ((0 4 7 3)); }
  outlet { type patch; faces ((1 2 6 5)); }
  sides { type wall; faces ((0 1 5 4) (3 7 6 2) (0 3 2 1) (4 5 6 7)); }
);
END
  } >"$at/system/blockMeshDict"
  { head_of dictionary controlDict
    echo 'startFrom startTime; startTime 0; stopAt endTime; endTime 0.1; deltaT 0.1; writeControl timeStep; writeInterval 1;'
    echo "$1"
  } >"$at/system/controlDict"
  { head_of dictionary fvSchemes
    echo 'ddtSchemes { default Euler; } gradSchemes { default Gauss linear; } divSchemes { default Gauss linear; }'
    echo 'laplacianSchemes { default Gauss linear orthogonal; } interpolationSchemes { default linear; } snGradSchemes { default orthogonal; }'
  } >"$at/system/fvSchemes"
  { head_of dictionary fvSolution
    echo 'solvers { p { solver PCG; preconditioner DIC; tolerance 1e-6; relTol 0; }'
    echo 'pFinal { $p; } U { solver smoothSolver; smoother symGaussSeidel; tolerance 1e-6; relTol 0; } }'
    echo 'PISO { nCorrectors 2; nNonOrthogonalCorrectors 0; pRefCell 0; pRefValue 0; }'
  } >"$at/system/fvSolution"
  { head_of dictionary transportProperties; echo 'nu [0 2 -1 0 0 0 0] 1;'; } >"$at/constant/transportProperties"
  { head_of volVectorField U
    echo 'dimensions [0 1 -1 0 0 0 0]; internalField uniform (0 0 0);'
    echo 'boundaryField { inlet { type fixedValue; value uniform (1 0 0); } outlet { type zeroGradient; } sides { type noSlip; } }'
  } >"$at/0/U"
  { head_of volScalarField p
    echo 'dimensions [0 2 -2 0 0 0 0]; internalField uniform 0;'
    echo 'boundaryField { inlet { type zeroGradient; } outlet { type fixedValue; value uniform 0; } sides { type zeroGradient; } }'
  } >"$at/0/p"
  environment=(WM_PROJECT_DIR=/usr/share/openfoam FOAM_ETC=/usr/share/openfoam/etc)
  inside blockMesh -case /tmp/duct >"$at/mesh.txt" 2>&1 || { tail -5 "$at/mesh.txt"; return; }
  if inside icoFoam -case /tmp/duct >"$at/log.txt" 2>&1; then
    echo "ran to $(ls -d "$at"/0.1 | xargs basename)"
  else
    grep -h -A1 FATAL "$at/log.txt" | tr -d '>' | sed 's/^[- ]*//; s/ *$//' | tail -2
  fi
}

none='functions {}'
mean='functions { mean { type fieldAverage; libs (fieldFunctionObjects); writeControl writeTime;
  fields ( p { mean on; prime2Mean off; base time; } ); } }'
make_root bookworm openfoam=1912.200626-1+b1
expect "$(flow "$none"; flow "$mean")" <<'END'
ran to 0.1
ran to 0.1
END
make_root trixie openfoam=1912.200626-3+b1
expect "$(flow "$none"; flow "$mean")" <<'END'
ran to 0.1
FOAM FATAL IO ERROR:
error in IOstream "sha1" for operation Foam::Ostream& Foam::operator<<(Ostream&, const word&)
END
