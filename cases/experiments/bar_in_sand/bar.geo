// A round bar in a flask of sand, held at its lower end, with or without a flange at the upper one. Axisymmetric: x is the
// radius, y along the bar, lengths in mm. All of them are assumed (../README.md).
//
//   length + above +-------------------------+  cover
//                  |          sand           |
//           length +-----------+             |
//                  |  flange   |             |
//   length - thick +------+----+             | flask
//                  | bar  |                  |
//                0 +------+------------------+  foot: load cell and flask
//                  0     bar  wide         flask
DefineConstant[ flange = {1, Name "flange"}, fine = {1, Name "fine"}, length = {565, Name "length"}, bar = {12.5, Name "bar"},
                wide = {20, Name "wide"}, thick = {10, Name "thick"}, flask = {70, Name "flask"}, above = {40, Name "above"} ];
r() = {0, bar, wide, flask};
y() = {0, length - thick, length, length + above};
For j In {0:3}
  For i In {0:3}
    Point(1 + i + 4*j) = {r(i), y(j), 0};
  EndFor
EndFor
// Lines along the radius 100 + i + 3 j, along the bar 200 + i + 4 j.
For j In {0:3}
  For i In {0:2}
    Line(100 + i + 3*j) = {1 + i + 4*j, 2 + i + 4*j};
  EndFor
EndFor
For j In {0:2}
  For i In {0:3}
    Line(200 + i + 4*j) = {1 + i + 4*j, 1 + i + 4*(j + 1)};
  EndFor
EndFor
For j In {0:2}
  For i In {0:2}
    Curve Loop(1 + i + 3*j) = {100 + i + 3*j, 200 + i + 1 + 4*j, -(100 + i + 3*(j + 1)), -(200 + i + 4*j)};
    Plane Surface(1 + i + 3*j) = {1 + i + 3*j};
    Transfinite Surface{1 + i + 3*j};
  EndFor
EndFor
For j In {0:3}
  Transfinite Curve{100 + 3*j} = 4*fine + 1;
  Transfinite Curve{101 + 3*j} = 4*fine + 1;
  Transfinite Curve{102 + 3*j} = 7*fine + 1 Using Progression 1.25^(1/fine);
EndFor
For i In {0:3}
  Transfinite Curve{-(200 + i)} = 40*fine + 1 Using Progression 1.05^(1/fine);
  Transfinite Curve{204 + i} = 4*fine + 1;
  Transfinite Curve{208 + i} = 7*fine + 1 Using Progression 1.25^(1/fine);
EndFor
Recombine Surface{2, 3, 6, 7, 8, 9};   // of the metal triangles, whose elements open pores
If (flange == 1)
  Physical Surface("casting") = {1, 4, 5};
  Physical Surface("sand") = {2, 3, 6, 7, 8, 9};
Else
  Recombine Surface{5};
  Physical Surface("casting") = {1, 4};
  Physical Surface("sand") = {2, 3, 5, 6, 7, 8, 9};
EndIf
Physical Curve("held") = {100};
Physical Curve("foot") = {101, 102};
Physical Curve("flask") = {203, 207, 211};
Physical Curve("cover") = {109, 110, 111};
