// A sheet on a table and the tip of a tool on the sheet (monograph 7.2). Lengths in mm.
// Sheet: 60 x 2 quads. Tool: 111 quads = 27 around the radius + 9 x 6 above the flat + 15 x 2 on top.

length = 30;                // of the sheet
thickness = 0.8;
start = 2.5;                // from the sheet's left edge to the tool's
tip = 10;                   // length of the tool
radius = 2.5;               // of the bottom corner of its right edge
height = 5;                 // of the tool: chosen
n_length = 60; n_thickness = 2;
n_flat = 9;                 // along the flat
n_radius = 3;               // on each side of a block of the quarter disc
n_top = 2;                  // above the radius

// The sheet.
Point(1) = {0, 0, 0};
Point(2) = {length, 0, 0};
Point(3) = {length, thickness, 0};
Point(4) = {0, thickness, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = n_length + 1;
Transfinite Curve {2, 4} = n_thickness + 1;

// The tool: the quarter disc around `c` of three blocks that meet in `m`, a block above the flat, two on top.
x0 = start; x1 = start + tip - radius; x2 = start + tip;
y0 = thickness; y1 = thickness + radius; y2 = thickness + height;
r = radius;
Point(10) = {x0, y0, 0};
Point(11) = {x1, y0, 0};
Point(12) = {x1 + r * Sin(Pi / 4), y1 - r * Cos(Pi / 4), 0};
Point(13) = {x2, y1, 0};
Point(14) = {x2, y2, 0};
Point(15) = {x1, y2, 0};
Point(16) = {x0, y2, 0};
Point(17) = {x0, y1, 0};
Point(18) = {x1, y1, 0};                        // centre of the arc
Point(19) = {x1, y0 + r / 2, 0};
Point(20) = {x1 + r / 2, y1, 0};
Point(21) = {x1 + 0.45 * r, y1 - 0.45 * r, 0};  // where the blocks of the quarter disc meet
Point(22) = {x0, y0 + r / 2, 0};
Point(23) = {x1 + r / 2, y2, 0};

Line(10) = {10, 11};                            // flat
Circle(11) = {11, 18, 12};
Circle(12) = {12, 18, 13};
Line(13) = {11, 19};
Line(14) = {19, 18};
Line(15) = {18, 20};
Line(16) = {20, 13};
Line(17) = {19, 21};
Line(18) = {20, 21};
Line(19) = {12, 21};
Line(20) = {10, 22};
Line(21) = {22, 17};
Line(22) = {22, 19};
Line(23) = {17, 18};
Line(24) = {17, 16};
Line(25) = {18, 15};
Line(26) = {20, 23};
Line(27) = {13, 14};
Line(28) = {16, 15};
Line(29) = {15, 23};
Line(30) = {23, 14};
Curve Loop(10) = {11, 19, -17, -13};
Curve Loop(11) = {12, -16, 18, -19};
Curve Loop(12) = {17, -18, -15, -14};
Curve Loop(13) = {10, 13, -22, -20};
Curve Loop(14) = {22, 14, -23, -21};
Curve Loop(15) = {23, 25, -28, -24};
Curve Loop(16) = {15, 26, -29, -25};
Curve Loop(17) = {16, 27, -30, -26};
For s In {10 : 17}
  Plane Surface(s) = {s};
EndFor
Transfinite Curve {11 : 21, 29, 30} = n_radius + 1;
Transfinite Curve {10, 22, 23, 28} = n_flat + 1;
Transfinite Curve {24 : 27} = n_top + 1;

Transfinite Surface {1, 10 : 17};
Recombine Surface {1, 10 : 17};

Physical Surface("sheet") = {1};
Physical Surface("tool") = {10 : 17};
Physical Curve("sheet_bottom") = {1};
Physical Curve("sheet_top") = {3};
Physical Curve("sheet_left") = {4};
Physical Curve("tool_sole") = {10 : 12};        // flat and radius
Physical Curve("tool_top") = {28 : 30};
