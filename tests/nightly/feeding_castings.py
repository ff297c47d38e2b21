"""Four castings of AlSi7Mg in furan sand as sections of unit depth: a plate with an open riser, a T, a bar with two heavy
ends, a stepped plate. Elements are triangles of the size `size` [mm]."""

from dataclasses import dataclass

SAND = 12  # size of elements at the outside of the mould [mm]


@dataclass(frozen=True)
class Section:
    """Corners of the metal and lowest and highest corner of the mould [mm]; half of the casting where both begin at x = 0,
    which is a plane of symmetry then."""

    name: str
    metal: tuple
    low: tuple
    high: tuple

    def halved(self):
        return self.low[0] == 0

    def opened(self):
        """Whether the metal reaches the top of the mould."""
        return max(y for _, y in self.metal) == self.high[1]


CASTINGS = (
    Section("plate_with_riser", ((0, 0), (100, 0), (100, 20), (25, 20), (25, 80), (0, 80)), (0, -40), (140, 80)),
    Section("tee", ((0, 0), (60, 0), (60, 20), (12, 20), (12, 70), (0, 70)), (0, -40), (100, 110)),
    Section("heavy_ends", ((0, 12), (50, 12), (50, 0), (90, 0), (90, 40), (50, 40), (50, 28), (0, 28)), (0, -40), (130, 80)),
    Section("stepped_plate", ((0, 0), (150, 0), (150, 35), (100, 35), (100, 20), (50, 20), (50, 10), (0, 10)), (-40, -40),
            (190, 75)))


def geometry(section):
    """The .geo file: groups casting, mould, outside and, where they are, middle and riser_top."""
    metal, (left, bottom), (right, top) = section.metal, section.low, section.high
    box = [(left, bottom), (right, bottom), (right, top), (left, top)]
    lines = ['DefineConstant[ size = {4, Name "size"} ];', 'SetFactory("OpenCASCADE");']
    for first, corners, size in ((1, metal, "size"), (101, box, SAND)):
        lines += [f"Point({first + i}) = {{{x}, {y}, 0, {size}}};" for i, (x, y) in enumerate(corners)]
        n = len(corners)
        lines += [f"Line({first + i}) = {{{first + i}, {first + (i + 1) % n}}};" for i in range(n)]
        lines += [f"Curve Loop({first}) = {{{first}:{first + n - 1}}}; Plane Surface({first}) = {{{first}}};"]
    # The mould is what the metal leaves of the box; both then share their skin.
    lines += ["BooleanFragments{ Surface{101}; Delete; }{ Surface{1}; Delete; }",
              f"all() = Surface In BoundingBox{{{left - 1}, {bottom - 1}, -1, {right + 1}, {top + 1}, 1}};",
              f"metal() = Surface In BoundingBox{{{min(x for x, _ in metal) - 0.1}, {min(y for _, y in metal) - 0.1}, -1, "
              f"{max(x for x, _ in metal) + 0.1}, {max(y for _, y in metal) + 0.1}, 1}};",
              "sand() = all(); sand() -= metal();", 'Physical Surface("casting") = {metal()};',
              'Physical Surface("mould") = {sand()};']

    def curves(name, low, high):
        corners = f"{low[0] - 0.1}, {low[1] - 0.1}, -1, {high[0] + 0.1}, {high[1] + 0.1}, 1"
        lines.extend([f"{name}() = Curve In BoundingBox{{{corners}}};", f'Physical Curve("{name}") = {{{name}()}};'])

    inner = [x for x, _ in metal]
    if section.halved():
        curves("middle", (0, min(y for x, y in metal if x == 0)), (0, max(y for x, y in metal if x == 0)))
    if section.opened():
        curves("riser_top", (0, top), (max(x for x, y in metal if y == top), top))
        curves("outside", (max(x for x, y in metal if y == top), top), (right, top))
    else:
        curves("outside", (left, top), (right, top))
    assert min(inner) >= left
    return "\n".join(lines) + "\n"


def case(section):
    """The case.toml; with --heat-only it is that of heat alone."""
    text = f'''title = "{section.name}"
[analysis]
kind = "plane_strain"
physics = "thermomechanical"
gravity = "9.81 m/s2"
[mesh]
file = "{section.name}.geo"
unit = "mm"
[time]
until = "solid"
end = "60 min"
step = "1 s"
adaptive = true
[[body]]
name = "casting"
material = "aluminium_alsi7mg"
initial_temperature = "680 degC"
[[body]]
name = "mould"
role = "mould"
material = "furan_sand"
initial_temperature = "20 degC"
[[interface]]
bodies = "all"
[[thermal_condition]]
name = "air"
group = "outside"
kind = "film"
coefficient = "10 W/m2/K"
ambient = "20 degC"
[gas]
follow = false
[output]
every = "1000 s"
'''
    if section.halved():
        text += '[[mechanical_condition]]\nname = "middle"\ngroup = "middle"\nkind = "displacement"\nux = "0 mm"\n'
    if section.opened():
        text += ('[[thermal_condition]]\nname = "top"\ngroup = "riser_top"\nkind = "film"\ncoefficient = "20 W/m2/K"\n'
                 'ambient = "20 degC"\n[criteria]\nfeeders = ["riser_top"]\n')
    return text
