// A disc with a riser on it, in sand. Axisymmetric: x is the radius, y upward, lengths in mm.
//
//   y  -- 40 + height: top of the sand and of the riser
//      |riser|                      |
//   40 |-----+--------+             |
//      |   casting    |    sand     |
//    0 +--------------+             |
//  -60 +----------------------------+
//      0   radius    60            130
DefineConstant[ radius = {34, Name "radius"}, height = {80, Name "height"}, size = {4, Name "size"} ];
top = 40 + height;
Point(1) = {0, 0, 0}; Point(2) = {60, 0, 0}; Point(3) = {60, 40, 0}; Point(4) = {radius, 40, 0}; Point(5) = {0, 40, 0};
Point(6) = {radius, top, 0}; Point(7) = {0, top, 0};
Point(8) = {0, -60, 0}; Point(9) = {130, -60, 0}; Point(10) = {130, top, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 1};
Line(6) = {4, 6}; Line(7) = {6, 7}; Line(8) = {7, 5};
Line(9) = {8, 9}; Line(10) = {9, 10}; Line(11) = {10, 6}; Line(12) = {1, 8};
Curve Loop(1) = {1:5}; Plane Surface(1) = {1};
Curve Loop(2) = {-4, 6, 7, 8}; Plane Surface(2) = {2};
Curve Loop(3) = {9, 10, 11, -6, -3, -2, -1, 12}; Plane Surface(3) = {3};
MeshSize{1:7} = size;
MeshSize{8, 9, 10} = 15;
Physical Surface("casting") = {1};
Physical Surface("riser") = {2};
Physical Surface("mould") = {3};
Physical Curve("riser_top") = {7};
Physical Curve("sand_top") = {11};
