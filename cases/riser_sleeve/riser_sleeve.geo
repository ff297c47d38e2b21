// A disc of steel with a riser in a sleeve, in sand. Axisymmetric: x is the radius, y upward, lengths in mm.
//
//   y  160 +---------------- sand ----------------+
//      140 |riser|sl|                             |      sl: sleeve of 12 mm
//          |     |  |                             |
//       40 |-----+--+------+                      |
//          |   casting     |                      |
//        0 +---------------+                      |
//      -80 +--------------------------------------+
//          0     35 47     110                   200
Point(1) = {0, -80, 0}; Point(2) = {200, -80, 0}; Point(3) = {200, 140, 0};
Point(4) = {0, 0, 0}; Point(5) = {110, 0, 0}; Point(6) = {110, 40, 0};
Point(7) = {47, 40, 0}; Point(8) = {35, 40, 0}; Point(9) = {0, 40, 0};
Point(10) = {47, 140, 0}; Point(11) = {35, 140, 0}; Point(12) = {0, 140, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 10}; Line(4) = {10, 7}; Line(5) = {7, 6}; Line(6) = {6, 5}; Line(7) = {5, 4};
Line(8) = {4, 1}; Line(9) = {4, 9}; Line(10) = {9, 8}; Line(11) = {8, 7}; Line(12) = {8, 11}; Line(13) = {11, 10}; Line(14) = {11, 12};
Line(15) = {12, 9};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7, 8}; Plane Surface(1) = {1};
Curve Loop(2) = {-7, -6, -5, -11, -10, -9}; Plane Surface(2) = {2};
Curve Loop(3) = {10, 12, 14, 15}; Plane Surface(3) = {3};
Curve Loop(4) = {11, -4, -13, -12}; Plane Surface(4) = {4};
MeshSize{4, 5, 6, 7, 8, 9, 10, 11, 12} = 5;
MeshSize{1, 2, 3} = 25;
Transfinite Curve {11, 13} = 5;    // four elements across the sleeve
Transfinite Curve {4, 12} = 26;
Transfinite Surface {4};
Physical Surface("mould") = {1};
Physical Surface("casting") = {2};
Physical Surface("riser") = {3};
Physical Surface("sleeve") = {4};
Physical Curve("top") = {3, 13};
Physical Curve("riser_top") = {14};
