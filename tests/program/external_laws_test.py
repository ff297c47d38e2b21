"""Laws from shared objects: the examples are compiled, loaded and compared with the law of the program; libraries that are wrong are refused."""

import csv
import math
import re
import shutil
import subprocess
import unittest

from program import SOURCES, ProgramTest, solidus

EXAMPLES = SOURCES / "examples" / "external_laws"


def table(file):
    """Header and columns of a CSV file; what is no number is left out."""
    with open(file, newline="") as rows:
        header, *lines = csv.reader(rows)
    return {name: [float(line[i]) for line in lines] for i, name in enumerate(header)
            if all(is_number(line[i]) for line in lines)}


def is_number(text):
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


def difference(a, b):
    """Largest difference of two columns, relative to the largest value."""
    return max(abs(x - y) for x, y in zip(a, b)) / max(max(abs(x) for x in a), 1e-300)


class ExternalLaws(ProgramTest):
    def setUp(self):
        super().setUp()
        shutil.copytree(EXAMPLES, self.folder, dirs_exist_ok=True)
        if shutil.which("cc") is None:
            self.skipTest("no C compiler")
        self.compile("cc", "libj2_generic.so", "j2_generic.c", "-lm")

    def compile(self, compiler, library, source, *options):
        subprocess.run([compiler, "-O2", "-shared", "-fPIC", "-o", library, source, *options], cwd=self.folder, check=True)

    def compile_umat(self):
        if shutil.which("gfortran") is None:
            self.skipTest("no gfortran: the UMAT is not tested")
        self.compile("gfortran", "libj2_umat.so", "j2_umat.f90")

    def refused(self, *arguments):
        """What it says where it must refuse."""
        result = solidus(*arguments, cwd=self.folder)
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        return result.stderr

    def card(self, changes):
        """The card of the generic law with lines replaced."""
        text = (self.folder / "steel_generic.toml").read_text()
        for old, new in changes.items():
            self.assertIn(old, text)
            text = text.replace(old, new)
        self.write("changed.toml", text)

    def law_in_c(self, body):
        """Compiles a UMAT written in C."""
        self.write("law.c", "#include <math.h>\n#include <stdlib.h>\nvoid umat_(double* stress, double* statev, double* ddsdde, "
                   "double* sse, double* spd, double* scd, double* rpl, double* ddsddt, double* drplde, double* drpldt, "
                   "double* stran, double* dstran, double* time, double* dtime, double* temp, double* dtemp, double* predef, "
                   "double* dpred, char* cmname, int* ndi, int* nshr, int* ntens, int* nstatv, double* props, int* nprops, "
                   "double* coords, double* drot, double* pnewdt) {\n"
                   "double E = 2e11, nu = 0.3, l = E * nu / ((1 + nu) * (1 - 2 * nu)), G = E / (2 * (1 + nu)); int i, j;\n"
                   "for (i = 0; i < 6; ++i) for (j = 0; j < 6; ++j)\n"
                   "  ddsdde[6 * j + i] = (i < 3 && j < 3 ? l : 0) + (i == j ? (i < 3 ? 2 * G : G) : 0);\n"
                   "for (i = 0; i < 6; ++i) for (j = 0; j < 6; ++j) stress[i] += ddsdde[6 * j + i] * dstran[j];\n"
                   + body + "}\n")
        self.compile("cc", "liblaw.so", "law.c", "-lm")
        self.write("changed.toml", 'like = "steel.toml"\n[young_modulus]\nvalue = "200 GPa"\n[external]\nlibrary = "liblaw.so"\n'
                   'interface = "umat"\nstate_variables = 1\n')

    def check_changed(self):
        """--check-law of the changed card: its lines by their names, and the exit code."""
        self.write("one.toml", 'material = "changed.toml"\ntemperature = "20 degC"\n'
                   '[[segment]]\nstrain = 0.001\nstrain_rate = "1e-3 1/s"\nsteps = 5\n')
        result = solidus("point", "one.toml", "--trust-laws", "--check-law", cwd=self.folder)
        lines = {line.split()[1]: line for line in result.stdout.splitlines() if line.startswith("  ")}
        return lines, result

    def test_the_law_at_a_point_is_that_of_the_program(self):
        self.compile_umat()
        self.done("point", "point.toml", "--trust-laws", "-o", "out")
        own = table(self.folder / "out/built_in.csv")
        for name in "generic", "umat":
            other = table(self.folder / f"out/{name}.csv")
            for column in own:
                if column.startswith(("stress_", "strain_", "plastic_", "equivalent", "work", "dissipated")):
                    self.assertLess(difference(own[column], other[column]), 1e-10, f"{name}: {column}")
            self.assertLess(difference(own["internal_energy[kJ/m3]"], other["internal_energy[kJ/m3]"]), 1e-5)

    def test_the_laws_pass_the_checks(self):
        self.compile_umat()
        out = self.done("point", "point.toml", "--trust-laws", "--check-law")
        self.assertNotIn("FAILED", out)
        self.assertEqual(out.count("passed tangent"), 3)

    def test_a_finite_element_run_has_the_stresses_of_the_program_and_closes_the_first_law(self):
        self.compile_umat()
        for heat, allowed in ("none", 1e-9), ("energy", 1e-5):
            runs = {}
            for card in "steel", "steel_generic", "steel_umat":
                out = self.folder / f"{heat}_{card}"
                self.done("run", "bar.toml", "--trust-laws", "--no-progress", "-o", str(out), "--set",
                          f"body.block.material={self.folder / card}.toml", "--set", f"coupling.structural_heating={heat}",
                          "--set", "mechanics.tolerance=1e-11", "--set", "heat.tolerance=1e-11")
                runs[card] = table(out / "steps.csv")
            for card in "steel_generic", "steel_umat":
                for column in "work[J]", "plastic_work[J]", "plastic_dissipation[J]", "T_max[degC]", "T_min[degC]":
                    self.assertLess(difference(runs["steel"][column], runs[card][column]), allowed, f"{heat} {card} {column}")
                if heat == "energy":
                    defect = max(abs(x) for x in runs[card]["energy_defect[J]"])
                    self.assertLess(defect, 1e-7 * max(runs[card]["heat_exchanged[J]"]))

    def test_a_run_goes_on_from_its_checkpoint_with_the_state_of_the_law(self):
        arguments = ["bar.toml", "--trust-laws", "--no-progress"]
        self.done("run", *arguments, "-o", "whole")
        self.done("run", *arguments, "-o", "parts", "--set", "time.end=4 s")
        self.done("run", *arguments, "-o", "parts", "--restart")
        whole, parts = table(self.folder / "whole/steps.csv"), table(self.folder / "parts/steps.csv")
        self.assertEqual(whole["plastic_work[J]"], parts["plastic_work[J]"])

    def test_metal_that_freezes_takes_the_law_when_it_is_solid(self):
        self.write("alloy.toml", 'like = "steel_generic.toml"\n[[phase_change]]\nname = "freezing"\nsolidification = true\n'
                   'latent_heat = "250 kJ/kg"\nvolume_change = -0.03\n[phase_change.fraction]\nsolidus = "900 degC"\nliquidus = "960 degC"\n')
        self.write("freezing.toml", 'material = "alloy.toml"\ntemperature = "1000 degC"\n[[segment]]\nkind = "uniaxial"\nhold = "strain"\n'
                   'temperature = "600 degC"\nduration = "40 s"\nsteps = 200\n')
        self.done("point", "freezing.toml", "--trust-laws", "-o", "frozen")
        files = list((self.folder / "frozen").glob("*.csv"))
        history = table(files[0])
        liquid = [abs(s) for s, f in zip(history["stress_xx[MPa]"], history["solid_fraction[1]"]) if f == 0]
        self.assertLess(max(liquid), 0.1 * max(history["von_mises[MPa]"]))
        for stress, temperature, plastic in zip(history["von_mises[MPa]"], history["temperature[degC]"], history["equivalent_plastic_strain[1]"]):
            self.assertLess(stress, 1.001 * (250 * (1 - 8e-4 * (temperature - 20)) + 2000 * plastic))
        self.assertGreater(history["equivalent_plastic_strain[1]"][-1], 0)

    def test_an_adiabatic_point_becomes_warm_by_the_share_of_plastic_work(self):
        self.compile_umat()
        self.write("share.toml", 'like = "steel_umat.toml"\n[external]\ndissipation = "share"\ntaylor_quinney = 0.5\n')
        self.write("own.toml", 'like = "steel.toml"\n[plasticity.taylor_quinney]\nvalue = 0.5\nsource = "example"\n')
        self.write("adiabatic.toml", 'material = "own.toml"\ntemperature = "20 degC"\nthermal = "adiabatic"\n[[segment]]\nstrain = 0.1\n'
                   'strain_rate = "1 1/s"\nsteps = 100\n[[segment]]\nstress = "0 MPa"\nduration = "1 s"\nsteps = 10\n[[curve]]\nname = "own"\n[[curve]]\nname = "library"\nmaterial = "share.toml"\n')
        self.done("point", "adiabatic.toml", "--trust-laws", "-o", "warm")
        for name in "own", "library":
            history = table(self.folder / f"warm/{name}.csv")
            warming = history["temperature[degC]"][-1] - history["temperature[degC]"][0]
            heat = 7800 * 600 * warming  # [J/m3]
            self.assertAlmostEqual(heat / (500 * history["work[kJ/m3]"][-1]), 1, delta=0.02, msg=name)

    def test_a_run_that_stops_says_which_law_asked_for_a_smaller_step_and_how_hot_it_was(self):
        self.law_in_c("if (*temp + *dtemp > 600 && *temp + *dtemp < 750) *pnewdt = 0.5;\n")
        result = solidus("run", "bar.toml", "--trust-laws", "--no-progress", "-o", "stopped", "--set",
                         f"body.block.material={self.folder / 'changed'}.toml", cwd=self.folder)
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        said, = re.findall(r"reason: the material law finds no state in a try of \S+ s: body 'block', element \d+: "
                           r"temperature (\S+) K, solid fraction 1", result.stderr)
        self.assertLessEqual(float(said), 750)
        self.assertGreater(float(said), 600)
        self.assertIn("equations: mechanics: a constitutive law asks for a smaller step", result.stderr)
        self.assertIn("tables and parameters of that material at this temperature", result.stderr)
        self.assertNotIn("max_iterations", result.stderr)

    def test_nothing_is_loaded_unless_the_user_says_so(self):
        for arguments in ["point", "point.toml"], ["check", "bar.toml"], ["run", "bar.toml"]:
            said = self.refused(*arguments)
            self.assertIn("steel_generic.toml:5:1", said)
            self.assertIn("--trust-laws", said)
        self.done("materials", "steel_generic.toml")  # reads the card alone

    def test_wrong_libraries_are_named_with_file_and_symbol(self):
        for changes, words in (
                ({"libj2_generic.so": "libnothing.so"}, ["there is no shared object", "libnothing.so"]),
                ({"libj2_generic.so": "j2_generic.c"}, ["cannot be loaded", "j2_generic.c"]),
                ({'"J2Generic"': '"J2"'}, ["speaks version 0"]),
                ({"4e-4, 8e-4": "4e-4"}, ["takes 6 properties", "FlowStressFall", "gives 5"]),
                ({"200e9, 0.3": "-200e9, 0.3"}, ["finds no answer", "Young's modulus is not positive"]),
                ({"200e9, 0.3": "200e9, 0.5"}, ["not finite"]),
                ({'"mfront"\nbehaviour = "J2Generic"': '"umat"\nstate_variables = 7'}, ["no symbol 'umat_'", "libj2_generic.so"]),
                ({"8e-4]": "8e-4]\ninitial_state = [1]"}, ["initial_state has 1", "7"]),
                ({"8e-4]": "8e-4]\nexternal_state_variables = [1]"}, ["has 0 external state variables", "gives 1"]),
                ({'"mfront"\nbehaviour = "J2Generic"': '"umat"'}, ["state_variables"])):
            self.card(changes)
            said = self.refused("point", "point.toml", "--trust-laws", "--set", 'curve.generic.material="changed.toml"')
            for word in words:
                self.assertIn(word, said)

    def test_schemes_that_need_more_of_a_law_are_refused_with_those_that_run(self):
        for scheme in "isentropic", "simultaneous", "double_pass":
            said = self.refused("check", "bar.toml", "--trust-laws", "--set", f"coupling.scheme={scheme}")
            self.assertIn(scheme, said)
            self.assertIn('scheme = "isothermal"', said)
        said = self.refused("check", "bar.toml", "--trust-laws", "--set", "mechanics.integration=two_step")
        self.assertIn("backward_euler", said)
        said = self.refused("check", "bar.toml", "--trust-laws", "--set", "mesh.element=tet4")
        self.assertIn("mixed elements", said)
        self.card({"200e9": "190e9"})
        said = self.refused("check", "bar.toml", "--trust-laws", "--set", f"body.block.material={self.folder}/changed.toml")
        self.assertIn("young_modulus", said)
        self.done("check", "bar.toml", "--trust-laws", "--set", "coupling.scheme=block_iterative", "--set",
                  "coupling.iteration.passes=isothermal")

    def test_a_library_that_crashes_or_ends_the_process_is_an_error_of_the_card(self):
        for body, words in (("*(volatile int*)8 = 1;", "it crashed (signal 11"), ("exit(0);", "it ended the process")):
            self.law_in_c(body)
            said = self.check_changed()[1].stderr
            self.assertIn(words, said)
            self.assertIn("while computing a small strain", said)
            self.assertIn("changed.toml:4:1", said)

    def test_checks_find_what_is_wrong_with_a_law(self):
        for body, name in (("for (i = 0; i < 36; ++i) ddsdde[i] *= 1.01;", "tangent"),
                           ("ddsdde[1] *= 1.5;", "symmetry"),
                           ("static int n = 0; stress[0] *= 1 + 1e-9 * n++;", "repetition"),
                           ("stress[0] += 1e10 * dstran[0]; ddsdde[0] += 1e10;", "isotropy"),
                           ("for (i = 0; i < 6; ++i) stress[i] *= 1.05; for (i = 0; i < 36; ++i) ddsdde[i] *= 1.05;", "moduli"),
                           ("if (dstran[0] > 1.00005e-4) stress[0] = NAN;", "history")):
            self.law_in_c(body)
            lines, result = self.check_changed()
            self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
            self.assertIn("FAILED", lines[name], body)
        self.law_in_c("")
        lines, result = self.check_changed()
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_a_tangent_that_is_declared_unsymmetric_may_be_so(self):
        # Stress in 11 from shear 12 that 12 does not give back: a full Newton iteration needs the skew part.
        self.law_in_c("stress[0] += 2e10 * dstran[3]; ddsdde[6 * 3] += 2e10;")
        card = self.folder / "changed.toml"
        card.write_text(card.read_text() + "unsymmetric = true\n")
        lines, _ = self.check_changed()
        self.assertIn("passed", lines["symmetry"])
        self.done("run", "bar.toml", "--trust-laws", "--no-progress", "-o", "skew", "--set", f"body.block.material={card}",
                  "--set", "coupling.structural_heating=none", "--set", "mechanics.inexact_newton=false")
        steps = table(self.folder / "skew/steps.csv")
        self.assertLessEqual(max(steps["mechanics_iterations[1]"]), 3)


if __name__ == "__main__":
    unittest.main()
