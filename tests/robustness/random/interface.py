"""Contact with any law of pressure, heat, friction and wear."""

from writing import around


def contact(rng, w, facts, kind, physics, shape, bodies, dynamic):
    last = "z" if kind == "solid" else "y"
    pairs = [("part_surface", "mould_surface")] if shape == "cylinder_in_mould" else [("upper_bottom", "lower_top")]
    sand = any(body.get("physics") == "heat" for body in bodies.values())
    for i, (slave, master) in enumerate(pairs):
        keys = {"name": f"interface_{i}"}
        if rng.random() < 0.3 and not sand:
            slave, master = master, slave
        keys |= {"slave": slave, "master": master}
        large = physics != "heat" and not sand and rng.random() < 0.3
        if large:
            keys |= {"formulation": "large_sliding", "smoothing": rng.random() < 0.3,
                     "integration": rng.choice(["gauss", "nodal"])}
        else:
            keys["integration"] = rng.choice(["segments", "segments", "nodal", "gauss"])
        if physics != "heat":
            keys["normal"] = rng.choice(["automatic", "penalty", "augmented_lagrangian"])
            keys["wet"] = rng.random() < 0.9
        facts["contact"] = [keys.get("formulation", "small_sliding"), keys["integration"], keys.get("normal", "")]
        w.section("[[contact]]", **keys)
        if physics != "mechanics" and rng.random() < 0.95:
            contact_heat(rng, w, facts, physics)
        if physics != "heat" and not sand and rng.random() < 0.3:
            friction(rng, w, facts)


def contact_heat(rng, w, facts, physics):
    h = around(rng, 100, 20000)
    law = rng.choice(["power", "power", "table", "spots"])
    gap = rng.choice(["constant", "gas", "table"]) if law != "spots" else rng.choice(["constant", "gas"])
    facts["contact_heat"] = [law, gap]
    keys = {"contact_law": law, "gap_law": gap}
    if law == "power":
        keys["conductance"] = f"{h:.6g} W/m2/K"
        if gap != "table" and rng.random() < 0.3:
            keys |= {"exponent": 0.95, "hardness": "300 MPa"}
    elif law == "table":
        keys["contact_conductance"] = {"argument_unit": "MPa", "unit": "W/m2/K",
                                       "points": [[0, round(h, 3)], [10, round(3 * h, 3)]]}
    if gap == "table":
        keys["gap_conductance"] = {"argument_unit": "mm", "unit": "W/m2/K",
                                   "points": [[0, round(h, 3)], [0.1, round(0.2 * h, 3)], [0.5, round(0.05 * h, 3)]]}
        if law == "power":
            keys["conductance"] = f"{round(h, 3)} W/m2/K"
    if gap == "gas":
        keys["gas_conductivity"] = "0.05 W/m/K"
    if law == "spots":
        keys["hardness"] = "300 MPa"
        if gap == "constant":
            keys["open_conductance"] = "100 W/m2/K"
    if rng.random() < 0.2:
        keys |= {"slave_emissivity": 0.8, "master_emissivity": 0.6}
    if law != "spots" and rng.random() < 0.2:
        keys["smooth"] = True
    w.section("[contact.heat]", **keys)
    if law == "spots":
        w.section("[contact.heat.asperities]", roughness="3 um", slope=0.15, conductivity="40 W/m/K",
                  hardness_coefficient="3 GPa", hardness_exponent=-0.2)


def friction(rng, w, facts):
    facts["friction"] = True
    coefficient = rng.choice([0.2, [0.3, -0.001], {"argument_unit": "degC", "unit": "1", "points": [[20, 0.3], [600, 0.1]]}])
    w.section("[contact.friction]", coefficient=coefficient, symmetric=rng.choice([None, True]))
    if isinstance(coefficient, list):
        w.add(internal_variable=rng.choice(["normal_work", "frictional_work"]), internal_variable_unit="kN/mm")
    if rng.random() < 0.3:
        w.section("[contact.wear]", archard=1e-5, hardness="1 GPa")
