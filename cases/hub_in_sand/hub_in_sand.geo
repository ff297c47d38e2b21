// Upper half of a wheel: hub, disc and rim, with a core in its bore. Axisymmetric: x is the radius, y the axis, in mm.
//
//   y 90 +-----+---------------------------+
//        |     |            mould          |
//     45 |core +-----+             +----+  |
//        |     | hub |             |rim |  |
//      8 |     |     +-------------+    |  |
//        |     |         disc           |  |
//      0 +-----+------------------------+--+  plane of symmetry
//        0    18    40            105  125 165
DefineConstant[ size = {4, Name "size"} ];
Point(1) = {0, 0, 0, size}; Point(2) = {18, 0, 0, size}; Point(3) = {125, 0, 0, size}; Point(4) = {165, 0, 0, 3*size};
Point(5) = {125, 45, 0, size}; Point(6) = {105, 45, 0, size}; Point(7) = {105, 8, 0, size}; Point(8) = {40, 8, 0, size};
Point(9) = {40, 45, 0, size}; Point(10) = {18, 45, 0, size};
Point(11) = {18, 90, 0, 2*size}; Point(12) = {0, 90, 0, 2*size}; Point(13) = {165, 90, 0, 3*size};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4};
Line(4) = {3, 5}; Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 9}; Line(9) = {9, 10}; Line(10) = {10, 2};
Line(11) = {10, 11}; Line(12) = {11, 12}; Line(13) = {12, 1}; Line(14) = {4, 13}; Line(15) = {13, 11};
Curve Loop(1) = {2, 4, 5, 6, 7, 8, 9, 10}; Plane Surface(1) = {1};
Curve Loop(2) = {1, -10, 11, 12, 13}; Plane Surface(2) = {2};
Curve Loop(3) = {3, 14, 15, -11, -9, -8, -7, -6, -5, -4}; Plane Surface(3) = {3};
Recombine Surface{2, 3};   // of the metal triangles, whose elements open pores; of the sand quadrilaterals, which slide without locking
Physical Surface("casting") = {1};
Physical Surface("core") = {2};
Physical Surface("mould") = {3};
Physical Curve("middle") = {1, 2, 3};
Physical Curve("flask") = {14};
Physical Curve("top") = {12, 15};
