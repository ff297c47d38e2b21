"""A made-up casting material."""

from writing import Writer, around


def material(rng, name, liquidus):
    """A made-up casting material: tables, any fraction curve, liquid model, hardening and rate law."""
    w = Writer()
    w.add(title=name, density=f"{around(rng, 2000, 8000):.4g} kg/m3", poisson_ratio=round(rng.uniform(0.2, 0.4), 3))
    hot = liquidus - 5

    def falling(low, high, least=0.05):
        top = around(rng, low, high)
        return [[20, top], [round(0.6 * hot), top * rng.uniform(0.5, 0.9)], [hot, top * rng.uniform(least, 0.4)]]

    def table(unit, points):
        return {"argument_unit": "degC", "unit": unit, "points": points}

    w.add(conductivity=table("W/m/K", falling(15, 300, 0.2)),
          specific_heat=table("J/kg/K", [[20, around(rng, 400, 900)], [hot, around(rng, 600, 1300)]]))
    w.add(young_modulus=table("GPa", falling(20, 200)),
          expansion=table("1/K", [[20, around(rng, 8e-6, 2e-5)], [hot, around(rng, 1e-5, 2.5e-5)]]))
    model = rng.choice(["maxwell", "maxwell", "modified_shear", "degenerated"])
    plastic = model == "degenerated" or rng.random() < 0.7
    w.add(liquid_model=model)
    if model == "maxwell" and rng.random() < 0.3:
        w.add(twice_shear_viscosity=f"{around(rng, 1e4, 1e9):.4g} Pa s")
    solidus = liquidus - rng.choice([0, 0.5, 5, 30, 80])
    kind = rng.choice(["linear", "linear", "table", "lever_rule", "scheil"])
    w.section("[[phase_change]]", name="freezing", solidification=True,
              latent_heat=f"{around(rng, 5e4, 5e5):.4g} J/kg", volume_change=rng.choice([0.0, -0.05, 0.01]))
    w.lines.append("[phase_change.fraction]")
    if kind == "linear":
        w.add(kind=kind, solidus=f"{solidus} degC", liquidus=f"{liquidus} degC")
    elif kind == "table":
        middle = 0.5 * (solidus + liquidus)
        w.add(kind=kind, temperatures=[f"{t} degC" for t in (solidus - 1, middle, liquidus)],
              fractions=[1.0, round(rng.uniform(0.2, 0.8), 2), 0.0])
    else:
        w.add(kind=kind, melting_point=f"{liquidus + 40} degC", liquidus=f"{liquidus} degC",
              eutectic=f"{liquidus - 60} degC", partition=round(rng.uniform(0.05, 0.6), 2))
    if rng.random() < 0.25:
        w.section("[[phase_change]]", name="in_the_solid", latent_heat=f"{around(rng, 1e3, 5e4):.4g} J/kg",
                  volume_change=rng.choice([0.0, 0.004, -0.004]))
        w.lines.append("[phase_change.fraction]")
        w.add(kind="linear", solidus=f"{0.5 * liquidus:.1f} degC",
              liquidus=f"{0.5 * liquidus + rng.choice([0, 20]):.1f} degC")
    if plastic:
        plasticity(rng, w, liquidus, model)
    return "\n".join(w.lines) + "\n"


def plasticity(rng, w, liquidus, model):
    w.section("[plasticity]")
    hardening = rng.choice(["none", "linear", "saturation", "power"])
    kinematic = rng.choice(["none", "none", "linear", "armstrong_frederick"])
    rate = "perzyna" if model == "degenerated" else rng.choice(["none", "perzyna"])
    stress = around(rng, 20, 300)
    points = [[20, stress], [0.6 * liquidus, 0.5 * stress], [liquidus, 1.0]]
    falling = {"argument_unit": "degC", "unit": "MPa", "points": points}
    w.add(isotropic_hardening=hardening, kinematic_hardening=kinematic, rate_dependence=rate, flow_stress=falling)
    if hardening == "linear":
        w.add(hardening_modulus=f"{around(rng, 50, 2000):.4g} MPa")
    if hardening == "saturation":
        w.add(saturation_stress={**falling, "points": [[t, round(1.5 * s, 4)] for t, s in points]},
              saturation_rate=round(around(rng, 5, 100), 2))
    if hardening == "power":
        w.add(reference_strain=round(around(rng, 0.001, 0.05), 4), hardening_exponent=round(rng.uniform(0.05, 0.4), 2))
    if kinematic != "none":
        w.add(kinematic_modulus=f"{around(rng, 100, 5000):.4g} MPa")
    if kinematic == "armstrong_frederick":
        w.add(recall=round(around(rng, 5, 100), 1))
    if rate == "perzyna":
        w.add(viscosity=f"{around(rng, 1e6, 1e10):.4g} Pa s", rate_exponent=rng.choice([1, 3, 5]), drag_stress="10 MPa")
