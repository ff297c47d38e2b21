"""What lies before a reader of the guide where a page begins to give commands: files, results of runs; and the few commands
that a test cannot type."""

from dataclasses import dataclass, field


@dataclass
class Scene:
    files: dict = field(default_factory=dict)  # name in the folder -> source in the repository
    texts: dict = field(default_factory=dict)  # name in the folder -> first words of the block of the page that it is
    lines: list = field(default_factory=list)  # typed before the page's own
    words: dict = field(default_factory=dict)  # what is typed for CASE, FOLDER, FILE, NAME
    end: str = "2 s"  # of runs, where they are shortened


BRACKET = {"bracket": "cases/bracket"}
# Any results will do for what is made of them: a run of the bracket stands for that of the crankshaft, whose mesh alone takes seconds.
CRANKSHAFT = ["solidus run bracket -o results/crankshaft/default"]
SCENES = {
    "README.md": Scene({"part.step": "tests/parts/flange.step"}, words={"FOLDER": "."}),
    "assistants.md": Scene(words={"FOLDER": "."}),
    "calibrate.md": Scene({"thermocouples": "examples/thermocouples"}),
    "case_file.md": Scene({"part.step": "tests/parts/flange.step"},
                          {"case.toml": 'title = "A steel block', "variants.toml": "[part.finer]"},
                          lines=["mkdir block && cp case.toml variants.toml block"],
                          words={"CASE": "cases/aluminium_cylinder", "FOLDER": "block"}, end="10 s"),
    "command_line.md": Scene(
        texts={"case.toml": "case_file.md"},
        lines=["mkdir -p ~/.local/share/bash-completion/completions ~/.zfunc ~/.config/fish/completions",
               "mkdir -p build && ln -s ~/solidus/build/release build/release"]),
    "compare.md": Scene(BRACKET, lines=[
        "solidus run bracket --heat-only -o results/bracket/default",
        "solidus run bracket --heat-only -o results/bracket/chilled --set body.mould.initial_temperature='10 degC'"]),
    "customer.md": Scene({**BRACKET, "customer.toml": "examples/customer/customer.toml", "logo.svg": "examples/customer/logo.svg"}),
    "export.md": Scene(BRACKET, lines=[*CRANKSHAFT, "cp -r results/crankshaft results/bracket"]),
    "external_laws.md": Scene(
        {"point.toml": "examples/external_laws/point.toml", "case.toml": "examples/external_laws/bar.toml",
         **{name: f"examples/external_laws/{name}" for name in (
             "j2_generic.c", "j2_umat.f90", "steel.toml", "steel_generic.toml", "steel_umat.toml")}},
        lines=["cc -O2 -shared -fPIC -o libj2_generic.so j2_generic.c -lm",
               "gfortran -O2 -shared -fPIC -o libj2_umat.so j2_umat.f90"]),
    "filling.md": Scene({"part.step": "tests/parts/flange.step"}, texts={"case.toml": 'title = "A plate on a die"'}),
    "findings.md": Scene(BRACKET, words={"CASE": "bracket"}),
    "getting_started.md": Scene({"bracket.geo": "cases/bracket/bracket.geo", "case.toml": "cases/bracket/case.toml"},
                                lines=["solidus run case.toml -o results/case/default"]),
    "heat_treatment.md": Scene({"examples": "examples"}),
    "install.md": Scene({"bracket.step": "cases/bracket_from_step/bracket.step", "aluminium_cylinder": "cases/aluminium_cylinder"},
                        words={"CASE": "hot_spots"}),
    "interfaces.md": Scene(BRACKET),
    "material_import.md": Scene(texts={"alsi9cu3.csv": "Temperature [C]"}),
    "materials.md": Scene(texts={"my_alloy.toml": 'title = "My alloy"'}, words={"FILE": "my_alloy.toml"}),
    "new_case.md": Scene({"bracket.step": "cases/bracket_from_step/bracket.step"}),
    "parallel.md": Scene({"case.toml": "cases/hot_spots/case.toml", "hot_spots.geo": "cases/hot_spots/hot_spots.geo"}, end="6 s"),
    "pattern.md": Scene({**BRACKET, "scan.csv": "examples/scan/scan.csv"}, lines=["solidus run bracket -o results/bracket/default"],
                        words={"CASE": "bracket"}),
    "plots.md": Scene({"case.toml": "cases/hot_spots/case.toml", "hot_spots.geo": "cases/hot_spots/hot_spots.geo"},
                      lines=["solidus run case.toml -o results/case/default"], words={"CASE": "case.toml", "RESULTS_DIR": "results/case/default"}),
    "point.md": Scene(words={"FILE": "cases/point/tensile.toml", "RESULTS_DIR": "results/point/tensile"}),
    "report.md": Scene(BRACKET, lines=[*CRANKSHAFT, "solidus run cases/aluminium_cylinder",
                                       "solidus run cases/aluminium_cylinder/h_const.toml"]),
    "reporting.md": Scene(BRACKET, words={"CASE": "bracket"}),
    "restart.md": Scene({"case.toml": "cases/hot_spots/case.toml", "hot_spots.geo": "cases/hot_spots/hot_spots.geo"},
                        lines=["solidus run cases/aluminium_cylinder --set time.end='1 s'", "solidus run case.toml --set time.end='2 s'"],
                        end="3 s"),
    "shots.md": Scene({"housing.step": "tests/parts/flange.step"}),
    "study.md": Scene({"case.toml": "cases/aluminium_cylinder/case.toml", "h_const.toml": "cases/aluminium_cylinder/h_const.toml"},
                      {"study.toml": 'title = "Pouring', "latin.toml": 'case = "h_const.toml"\nmethod'},
                      lines=["solidus study latin.toml --dry-run"], words={"FILE": "study.toml"}),
    "uncertain.md": Scene(texts={"case.toml": 'title = "A plate in a die"'}),
    "troubleshooting.md": Scene(texts={"case.toml": 'title = "A plate'}, words={"FILE": "~/solidus/cases/bracket/bracket.geo --unit mm"}),
}

# Commands that no test of a page types, and what runs them instead.
ELSEWHERE = {
    "solidus compare-shape MEASURED SHAPE": "tests/program/pattern_shape_test.py",
    "./dev test": "the suite itself",
    "./dev docs --site": "tests/python/site_test.py",
    "./dev release": "the same build, packed by tests/program/archive_test.py",
    "./dev release --tag": "the same build, and a tag",
    "./dev package": "packs a build for other processors, which takes twenty minutes; the page says when it was walked",
    "./dev build portable": "the same build",
    "./dev python": "tests/program/python_package_test.py imports what it builds",
    "./dev viewer --check": "needs the net (npm)",
    "solidus open dumbbell.step": "serves until Ctrl-C; tests/workbench clicks through its page",
    "apt install ./solidus_*_amd64.deb": "changes the machine; the page says when it was walked",
    "podman build -t solidus -f Containerfile .": "fetches an image",
    'podman run --rm -v "$PWD":/work solidus run case.toml': "the same image",
    "python3 -m venv --system-site-packages solidus-env": "builds the package of Python: minutes; the page says so",
    "solidus-env/bin/pip install --no-build-isolation .": "the same",
    "PYTHONPATH=python /usr/bin/python3": "opens an interpreter; its blocks are run by tests/program/python_simulations_test.py",
    "cmake --install build/release --component program --prefix ~/.local": "tests/program/install_test.py",
    "solidus design part.step --alloy medium_carbon_steel --process sand": "tests/program/design_test.py, with fewer runs",
    "solidus fill case.toml": "tests/program/fill_test.py, where OpenFOAM is installed",
    "solidus design bracket": "the same; that a case does as well as its part: tests/python/design_test.py",
}
