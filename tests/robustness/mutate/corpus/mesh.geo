// A block in another, with a size that a case may set.
DefineConstant[ size = {8, Name "size"} ];
Point(1) = {0, 0, 0, size};
Point(2) = {40, 0, 0, size};
Point(3) = {40, 20, 0, size};
Point(4) = {0, 20, 0, size};
For i In {1:4}
  Line(i) = {i, (i % 4) + 1};
EndFor
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Physical Surface("block") = {1};
Physical Curve("bottom") = {1};
