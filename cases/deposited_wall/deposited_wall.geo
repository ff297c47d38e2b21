// Half of a wall of ten beads on a plate, cut along its middle; lengths in mm. Hexahedra: the wall has two
// rows of elements for each layer.
DefineConstant[ size = {1.0, Name "size"} ];    // along the wall
DefineConstant[ layers = {10, Name "layers"} ]; // beads, 1.5 mm each
x() = {0, 10, 50, 60};
y() = {0, 2, 15};
nx() = {Ceil(6/size), Ceil(40/size), Ceil(6/size)};
ny() = {2, 6};
For j In {0:2}
  For i In {0:3}
    Point(1 + i + 4*j) = {x(i), y(j), -6};
  EndFor
EndFor
// Lines along x, then along y.
For j In {0:2}
  For i In {0:2}
    Line(100 + i + 3*j) = {1 + i + 4*j, 2 + i + 4*j};
    Transfinite Curve {100 + i + 3*j} = nx(i) + 1;
  EndFor
EndFor
For j In {0:1}
  For i In {0:3}
    Line(200 + i + 4*j) = {1 + i + 4*j, 5 + i + 4*j};
    If (j == 1)
      Transfinite Curve {200 + i + 4*j} = ny(j) + 1 Using Progression 1.3;
    Else
      Transfinite Curve {200 + i + 4*j} = ny(j) + 1;
    EndIf
  EndFor
EndFor
plate() = {}; top() = {}; bottom() = {}; middle() = {};
For j In {0:1}
  For i In {0:2}
    s = 1 + i + 3*j;
    Curve Loop(s) = {100 + i + 3*j, 201 + i + 4*j, -(100 + i + 3*(j + 1)), -(200 + i + 4*j)};
    Plane Surface(s) = {s};
    Transfinite Surface {s};
    Recombine Surface {s};
    e() = Extrude {0, 0, 6} { Surface{s}; Layers{4}; Recombine; };
    plate() += e(1);
    bottom() += s;
    top() += e(0);
    If (i == 1 && j == 0)
      w() = Extrude {0, 0, 1.5*layers} { Surface{e(0)}; Layers{2*layers}; Recombine; };
    EndIf
  EndFor
EndFor
Physical Volume("plate") = plate();
Physical Volume("wall") = {w(1)};
Physical Surface("bottom") = bottom();
Physical Surface("skin") = {top(), w(0), w(3), w(4), w(5)};
