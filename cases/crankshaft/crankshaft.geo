// A four-cylinder crankshaft in a block of sand (monograph 7.4). Lengths in mm.
//
// x along the shaft, pins in the plane x-y, z up. The origin is on the axis in the middle of the centre journal.
// Part and sand share no nodes, and their meshes do not match: contact joins them.
SetFactory("OpenCASCADE");

DefineConstant[
  size = {10.4, Name "size"}                   // of the elements in the part
  sand_growth = {3, Name "sand_growth"}        // size at the sand's outside, in sizes of the part
  with_sand = {1, Name "with_sand"}            // 0: the shaft alone, for export_step.py
];

// The shaft.
main_diameter = 54;     main_width = 26;
pin_diameter = 48;      pin_width = 28;
stroke = 80;
web_thickness = 18;
cheek_radius = 34;                             // of the web around its pin
waist = 37;                                    // half width of the web at the axis
counterweight_radius = 66;
nose_diameter = 34;     nose_length = 50;
flange_diameter = 90;   flange_thickness = 20;
sand = 50;                                     // around the shaft

pitch = main_width + 2 * web_thickness + pin_width;
r = stroke / 2;

// Outline of a web in the plane x = 0 with its pin at +y: 1, the cheek; 2, 3 flanks; 4 the counterweight.
Macro Web                                      // at `x`, pin on the side `side` of the axis
  y0 = side * r;
  a = -side * counterweight_radius * 0.35; w = Sqrt(counterweight_radius^2 - a^2);
  p = newp;
  Point(p) = {x, y0, -cheek_radius};
  Point(p + 1) = {x, y0, 0};
  Point(p + 2) = {x, y0, cheek_radius};
  Point(p + 3) = {x, y0 + side * cheek_radius, 0};
  Point(p + 4) = {x, 0, waist};
  Point(p + 5) = {x, a, w};
  Point(p + 6) = {x, -side * counterweight_radius, 0};
  Point(p + 7) = {x, a, -w};
  Point(p + 8) = {x, 0, -waist};
  Point(p + 9) = {x, 0, 0};
  l = newl;
  Circle(l) = {p, p + 1, p + 3};
  Circle(l + 1) = {p + 3, p + 1, p + 2};
  Line(l + 2) = {p + 2, p + 4};
  Line(l + 3) = {p + 4, p + 5};
  Circle(l + 4) = {p + 5, p + 9, p + 6};
  Circle(l + 5) = {p + 6, p + 9, p + 7};
  Line(l + 6) = {p + 7, p + 8};
  Line(l + 7) = {p + 8, p};
  Curve Loop(l + 8) = {l : l + 7};
  s = news;
  Plane Surface(s) = {l + 8};
  e[] = Extrude {web_thickness, 0, 0} { Surface{s}; };
  Delete { Surface{s}; }
  parts[] += e[1];
Return

Macro Journal                                    // a cylinder from `x`, `width` long, its axis at `y`
  v = newv;
  Cylinder(v) = {x, y, 0, width, 0, 0, diameter / 2};
  parts[] += v;
Return

parts[] = {};
left = -2 * pitch - main_width / 2;            // of the first journal
For i In {0 : 4}
  x = left + i * pitch; y = 0; width = main_width; diameter = main_diameter;
  Call Journal;
EndFor
For i In {0 : 3}
  If (i == 0 || i == 3)
    side = 1;
  Else
    side = -1;
  EndIf
  x = left + i * pitch + main_width;
  Call Web;
  x += web_thickness;
  y = side * r; width = pin_width; diameter = pin_diameter;
  Call Journal;
  x += pin_width;
  Call Web;
EndFor
x = left - nose_length; y = 0; width = nose_length; diameter = nose_diameter;
Call Journal;
right = left + 4 * pitch + main_width;
x = right; width = flange_thickness; diameter = flange_diameter;
Call Journal;

shaft[] = BooleanUnion{ Volume{parts[0]}; Delete; }{ Volume{parts[{1 : #parts[] - 1}]}; Delete; };

skin[] = Abs(Boundary{ Volume{shaft[0]}; });
Physical Volume("part") = {shaft[]};
Physical Surface("part_surface") = {skin[]};
Characteristic Length{ PointsOf{ Volume{shaft[0]}; } } = size;

// Three points that carry the shaft once the sand is gone: two below the axis, one under a counterweight.
Macro Corner                                   // the point of the shaft at x, y, z
  d = 1e-3;
  corner[] = Point In BoundingBox {x - d, y - d, z - d, x + d, y + d, z + d};
  corner[] = {corner[0]};                      // before the sand is made, which has one there too
Return
x = left + main_width; y = 0; z = -waist;
Call Corner;
Physical Point("support_left") = {corner[]};
x = right - main_width; y = 0; z = -waist;
Call Corner;
Physical Point("support_right") = {corner[]};
x = left + main_width; y = -0.35 * counterweight_radius; z = -Sqrt(counterweight_radius^2 - y^2);
Call Corner;
Physical Point("support_side") = {corner[]};

// The sand: a block less a copy of the shaft, so that nothing is shared.
If (with_sand)
  hollow[] = Translate {0, 0, 0} { Duplicata { Volume{shaft[0]}; } };
  x0 = left - nose_length - sand;     x1 = right + flange_thickness + sand;
  y1 = r + cheek_radius + sand;
  z1 = counterweight_radius + sand;
  b = newv;
  Box(b) = {x0, -y1, -z1, x1 - x0, 2 * y1, 2 * z1};
  mould[] = BooleanDifference{ Volume{b}; Delete; }{ Volume{hollow[0]}; Delete; };

  all[] = Abs(Boundary{ Volume{mould[0]}; });
  rim = 1;                                     // the faces inside a box a little smaller than the block
  inside[] = Surface In BoundingBox {x0 + rim, -y1 + rim, -z1 + rim, x1 - rim, y1 - rim, z1 - rim};
  cavity[] = inside[]; cavity[] -= skin[];
  outside[] = all[]; outside[] -= cavity[];
  Physical Volume("sand") = {mould[]};
  Physical Surface("cavity") = {cavity[]};
  Physical Surface("sand_outside") = {outside[]};
  Characteristic Length{ PointsOf{ Surface{cavity[]}; } } = size;
  Characteristic Length{ PointsOf{ Surface{outside[]}; } } = sand_growth * size;
EndIf
