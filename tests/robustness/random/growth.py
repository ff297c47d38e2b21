"""A body that grows: behind a front, in layers, or bead by bead along a path."""


def growth(rng, w, case, kind):
    """Adds the deposition of the one body of a block, and the file of its path."""
    facts = case.facts
    size, end = facts["size"], facts["end"]
    last = "z" if kind == "solid" else "y"
    way = rng.choice(["front", "times", "path"])
    facts["growth"] = way
    keys = {"name": "growth", "body": "block", "kind": way}
    if rng.random() < 0.6:
        keys["bare"] = f"{last}_max"
    if rng.random() < 0.4:
        keys["interval"] = f"{end * rng.uniform(0.05, 0.4):.6g} s"
    height = size[-1]
    lasting = end * rng.uniform(0.3, 1.3)  # births may go on when the run has ended
    if way == "front":
        keys["from"] = ["0 mm"] * (len(size) - 1) + [f"{height * rng.uniform(0, 0.5):.4g} mm"]
        keys["normal"] = [round(rng.uniform(-0.3, 0.3), 2) for _ in size[:-1]] + [1]
        keys["speed"] = f"{height / lasting:.6g} mm/s"
        keys["start"] = f"{end * rng.choice([0, 0, 0.2]):.6g} s"
    elif way == "times":
        layer, pause = height * rng.uniform(0.1, 0.5) / 1000, lasting * rng.uniform(0.1, 0.5)
        keys["time"] = {"formula": f"{pause:.6g}*rint({last}/{layer:.6g} - 0.5) + {rng.choice([0, lasting]):.6g}*x"}
    else:
        keys["width"] = f"{3 * max(size):.4g} mm"
        passes = rng.randint(1, 4)
        keys["depth"] = f"{1.01 * height / passes:.6g} mm"
        case.files["path.csv"] = path(rng, size, passes, lasting)
    w.section("[[deposition]]", **keys)
    if way == "path":
        w.section("[deposition.path]", file="path.csv")


def path(rng, size, passes, lasting):
    """To and fro along x, a pause after each pass."""
    middle = [f"{0.5 * s:.6g}" for s in size[1:-1]]
    rows = [",".join(["t[s]", "x[mm]", "y[mm]"] + ["z[mm]"] * (len(size) - 2) + ["on"])]
    each, pause = lasting / passes, rng.uniform(0, 0.5)
    for k in range(passes):
        height = f"{size[-1] * (k + 1) / passes:.6g}"
        ends = [f"{-0.1 * size[0]:.6g}", f"{1.1 * size[0]:.6g}"]
        for share, x, on in ((0, ends[k % 2], 1), (0.99 - pause, ends[1 - k % 2], 0)):
            rows.append(",".join([f"{(k + share) * each:.6g}", x, *middle, height, str(on)]))
    return "\n".join(rows) + "\n"
