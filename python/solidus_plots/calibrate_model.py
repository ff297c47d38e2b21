"""A case as a function of its unknowns: assignments for `solidus run`, predictions of readings and their derivatives."""

from dataclasses import dataclass
import hashlib
import json
import tomllib

import numpy as np

from solidus_plots.calibrate_fit import RunFailed
from solidus_plots.history import Table, read_table
from solidus_plots.many_runs import Runner

FORWARD_CHANGE = 1e-6  # of a parameter, over its size, in forward differentiation
DIFFERENCE = 1e-2  # the same in differences of runs, whose steps may follow their errors
IN_RUNS = ("key", "card", "place")  # unknowns that a run depends on; the others act on its curves
LENGTHS = {"m": 1e3, "cm": 10.0, "mm": 1.0, "um": 1e-3, "µm": 1e-3, "": 1e3}  # in mm


def number_text(value, unit):
    return f"{float(value)!r} {unit}" if unit else repr(float(value))


def assignments(unknown, values):
    """What `--set` gets for the values of an unknown."""
    values = [float(value) for value in values]
    if unknown.kind == "place":
        moved = []
        for text, along in zip(unknown.place, unit_vector(unknown.direction)):
            number, _, unit = str(text).strip().partition(" ")
            moved.append(number_text(float(number) * LENGTHS[unit.strip()] + values[0] * along, "mm"))
        return [f"probe.{unknown.probe}.point={json.dumps(moved)}"]
    if unknown.kind != "key":
        return []
    texts = [number_text(value, unknown.unit) for value in values]
    first = [f"{key}={texts[0]}" for key in unknown.also]
    if not unknown.at:
        return [f"{unknown.key}={texts[0]}", *first]
    if unknown.key.endswith(".at"):  # tables of a contact at several temperatures, of one conductance each
        knots = [f'{{ temperature = "{float(at)!r} {unknown.argument_unit}", contact_conductance = "{text}", '
                 f'gap_conductance = "{text}" }}' for at, text in zip(unknown.at, texts)]
        return [f"{unknown.key}=[{', '.join(knots)}]", *first]
    points = ", ".join(f"[{float(at)!r}, {value!r}]" for at, value in zip(unknown.at, values))
    return [f'{unknown.key}={{ of = "{unknown.of}", argument_unit = "{unknown.argument_unit}", '
            f'unit = "{unknown.unit or 1}", points = [{points}] }}', *first]


def card_text(unknowns_with_values):
    """A card that is like the one of the case but for the properties that are unknown."""
    lines = [f"like = {json.dumps(unknowns_with_values[0][0].material)}"]
    for unknown, values in unknowns_with_values:
        lines.append(f"[{unknown.of_card}]")
        if unknown.at:
            points = ", ".join(f"[{float(at)!r}, {float(value)!r}]" for at, value in zip(unknown.at, values))
            lines += [f'argument_unit = "{unknown.argument_unit}"', f'unit = "{unknown.unit or 1}"', f"points = [{points}]"]
        else:
            lines.append(f'value = "{number_text(float(values[0]), unknown.unit)}"')
        lines.append('source = "solidus calibrate"')
    return "\n".join(lines) + "\n"


def unit_vector(direction):
    vector = np.array(direction, dtype=float)
    return vector / np.linalg.norm(vector)


def lagged(time, temperature, lag):
    """What a sensor of first order shows of a temperature that is straight between the times: τ dy/dt + y = T, y = T at
    the start."""
    if lag <= 0:
        return np.array(temperature)
    shown = np.empty_like(temperature)
    shown[0] = temperature[0]
    for k in range(len(time) - 1):
        dt = time[k + 1] - time[k]
        slope, kept = (temperature[k + 1] - temperature[k]) / dt, np.exp(-dt / lag)
        shown[k + 1] = temperature[k + 1] - lag * slope + (shown[k] - temperature[k] + lag * slope) * kept
    return shown


@dataclass
class Prediction:
    values: np.ndarray  # [reading]
    derivatives: np.ndarray | None  # [reading, parameter]


class Model:
    """Predictions of all readings, run by run."""

    def __init__(self, case, words, calibration, readings, folder, jobs, forward, dear=False):
        """words: of all runs; forward: derivatives are those of `run --sensitivities`, else differences of runs; dear: such a
        run costs more than two without."""
        self.calibration, self.readings, self.folder, self.jobs, self.forward = calibration, readings, folder, jobs, forward
        self.dear = dear
        self.with_derivatives = 0  # runs that gave them
        self.words = words
        self.parameters = calibration.parameters()
        self.runner = Runner(case, False)
        self.runs = 0
        self.seconds = []  # of each run
        self.last = None  # folder of the last run at a point of the fit

    # --- runs -----------------------------------------------------------------------------------------------

    def _split(self, theta):
        """The unknowns with their values."""
        at = 0
        for unknown in self.calibration.unknowns:
            count = len(unknown.parameters)
            yield unknown, theta[at:at + count], at
            at += count

    def words_of(self, theta):
        words = list(self.words)
        for unknown, _, _ in self._split(theta):
            for assignment in self._assignments(unknown, theta):
                words += ["--set", assignment]
        return words

    def _assignments(self, unknown, theta):
        """What `--set` gets for an unknown at this point. Cards are written into the folder of the fit."""
        if unknown.kind != "card":
            return assignments(unknown, next(values for other, values, _ in self._split(theta) if other is unknown))
        text = card_text([(other, values) for other, values, _ in self._split(theta)
                          if other.kind == "card" and other.key == unknown.key])
        card = (self.folder.parent / "cards" / f"{hashlib.sha256(text.encode()).hexdigest()[:16]}.toml").resolve()
        card.parent.mkdir(parents=True, exist_ok=True)
        card.write_text(text)
        return [f"{unknown.key}={json.dumps(str(card))}"]

    def change_of(self, number, theta):
        """By how much a parameter is moved for its derivative."""
        parameter = self.parameters[number]
        spread = parameter.deviation if parameter.deviation and not parameter.logarithmic else 0.0
        within = parameter.high - parameter.low if np.isfinite(parameter.high - parameter.low) else 0.0
        size = max(abs(theta[number]), spread, 0.1 * within) or 1.0
        change = (FORWARD_CHANGE if self.forward else DIFFERENCE) * size
        return change if theta[number] + change <= parameter.high else -change

    def in_runs(self):
        """Numbers of the parameters that a run depends on."""
        return [at + i for unknown, _, at in self._split(np.zeros(len(self.parameters))) if unknown.kind in IN_RUNS
                for i in range(len(unknown.parameters))]

    def _list_of_parameters(self, theta, file):
        lines = []
        for unknown, values, at in self._split(theta):
            if unknown.kind not in IN_RUNS:
                continue
            for i in range(at, at + len(values)):
                moved = theta.copy()
                moved[i] += self.change_of(i, theta)
                lines += ["[[parameter]]", f"name = {json.dumps(str(i))}", f"change = {float(moved[i] - theta[i])!r}",
                          f"set = {json.dumps(self._assignments(unknown, moved), ensure_ascii=False)}"]
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text("\n".join(lines) + "\n")

    def _run_all(self, wanted):
        """Runs at the same time. Throws RunFailed with the reason of the first that fails."""
        records = self.runner.run_all(wanted, self.jobs, lambda number, record: None)
        if records is None:
            raise KeyboardInterrupt
        for record, (folder, _) in zip(records, wanted):
            self.runs += 1
            self.seconds.append(record["seconds"])
            if record["code"] != 0:
                raise RunFailed(f"the run in {folder} failed: {record['reason']}")

    def predict(self, theta, derivatives):
        """Throws RunFailed where a run fails."""
        theta = np.array(theta, dtype=float)
        folder = self.folder / f"run_{self.runs + 1}"
        words = self.words_of(theta)
        moved = self.in_runs() if derivatives else []
        if derivatives and self.forward and moved:
            # `run` gives the list of parameters its own folder, which a run empties of what it wrote before.
            self._list_of_parameters(theta, self.folder / "parameters.toml")
            words += ["--sensitivities", str(self.folder / "parameters.toml")]
            self.with_derivatives += 1
        wanted = [(folder, words)]
        beside = []
        if derivatives and not self.forward:
            for number in moved:
                change = self.change_of(number, theta)
                at = theta.copy()
                at[number] += change
                beside.append((number, at[number] - theta[number], folder.with_name(f"{folder.name}_by_{number}"), at))
            wanted += [(other, self.words_of(at)) for _, _, other, at in beside]
        self._run_all(wanted)
        self.last = folder
        history = read_table(folder / "history.csv")
        slopes = {}
        if derivatives and self.forward and moved:
            table = read_table(folder / "sensitivities.csv")
            for number in moved:
                slopes[number] = {r.header: table[f"{r.header} by {number}"] for r in self.readings}
        for number, change, other, _ in beside:
            there = read_table(other / "history.csv")
            slopes[number] = {r.header: _difference(history, there, r.header) / change for r in self.readings}
        return self._read(theta, history, slopes, derivatives)

    # --- curves ---------------------------------------------------------------------------------------------

    def _of(self, kind, readings, theta, default):
        """The value and number of the lag or the clock of an observation."""
        for unknown, values, at in self._split(theta):
            if unknown.kind == kind and (not unknown.observations or readings.name in unknown.observations):
                return values[0], at
        return default, None

    def times(self, readings, theta):
        """Of the readings in the run, with the clock at this point."""
        return np.array([]) if readings.at_end else readings.time + self._of("clock", readings, theta, 0.0)[0]

    def _read(self, theta, history, slopes, derivatives):
        values, rows = [], []
        for readings in self.readings:
            time, curve = history["time[s]"], history[readings.header]
            row = np.zeros((len(readings.values), len(self.parameters)))
            if readings.at_end:
                values.append(curve[-1:])
                for number, of_number in slopes.items():
                    row[:, number] = of_number[readings.header][-1]
                rows.append(row)
                continue
            lag, of_lag = self._of("lag", readings, theta, readings.lag)
            of_shift = self._of("clock", readings, theta, 0.0)[1]
            at = np.clip(self.times(readings, theta), time[0], time[-1])
            shown = lagged(time, curve, lag)
            values.append(np.interp(at, time, shown))
            for number, of_number in slopes.items():
                row[:, number] = np.interp(at, time, lagged(time, of_number[readings.header], lag))
            if of_lag is not None and derivatives:
                change = 1e-4 * max(lag, 1e-3)
                row[:, of_lag] = (np.interp(at, time, lagged(time, curve, lag + change)) - values[-1]) / change
            if of_shift is not None and derivatives:
                piece = np.clip(np.searchsorted(time, at, side="right") - 1, 0, len(time) - 2)
                row[:, of_shift] = np.diff(shown)[piece] / np.diff(time)[piece]
            rows.append(row)
        return Prediction(np.concatenate(values), np.concatenate(rows) if derivatives else None)


def _difference(history, there, header):
    """there − here at the times of here: runs with steps that follow their errors have other ones."""
    if len(history["time[s]"]) == len(there["time[s]"]):
        return there[header] - history[header]
    return np.interp(history["time[s]"], there["time[s]"], there[header]) - history[header]


def resolved_case(program_output):
    """The case as `solidus resolve` prints it."""
    return tomllib.loads(program_output)


def probes_of(case):
    """Header of history.csv of each probe of a case -> its section."""
    found = {}
    for probe in case.get("probe", []):
        unit = probe.get("unit", "")
        found[f"{probe['name']}[{unit}]" if unit else probe["name"]] = probe
    return found


def deforms(case):
    return case.get("analysis", {}).get("physics", "thermomechanical") != "heat"


def _why_not_coupled(case):
    """What keeps a case of bodies that deform from forward differentiation; empty: nothing."""
    if case.get("analysis", {}).get("physics") == "mechanics":
        return "there is no heat"
    coupling = case.get("coupling", {})
    if coupling.get("scheme", "isentropic") not in ("isentropic", "isothermal") or coupling.get("thermal_flow", "kept") != "kept":
        return "bodies deform with another scheme than the isentropic or isothermal split"
    if coupling.get("order") != "mechanics_first":
        return "bodies deform after heat; --set 'coupling.order=\"mechanics_first\"' has derivatives"
    if "dynamics" in case:
        return "bodies have inertia"
    for contact in case.get("contact", []):
        if "friction" in contact or not str(contact.get("interface", {}).get("heat_capacity", "0")).startswith("0"):
            return f"the contact '{contact.get('name')}' rubs or stores heat"
    return ""


def why_differences(case, readings):
    """What keeps a case from forward differentiation; empty: nothing."""
    probes = probes_of(case)
    why = _why_not_coupled(case) if deforms(case) else ""
    if why:
        return why
    if case.get("time", {}).get("adaptive") or case.get("time", {}).get("steady"):
        return "steps follow their errors (time.adaptive)"
    if case.get("stage"):
        return "the case has stages"
    if case.get("heat", {}).get("integration", "closed") != "closed":
        return "heat is held at points (heat.integration)"
    known = ["temperature"]
    if deforms(case):
        known.append("displacement")
    others = [r.header for r in readings if probes.get(r.header, {}).get("field") not in known]
    return f"'{Table.name(others[0])}' is no {' or '.join(known)}" if others else ""
