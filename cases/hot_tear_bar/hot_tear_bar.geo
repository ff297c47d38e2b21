// Half of a bar with a hub in its middle and a flange at each end, in sand. Axisymmetric: x is the radius, y along the
// bar from its middle, lengths in mm.
//
//   y 170 +------------------ sand --------------+
//     130 +-----------------+                    |
//         |   flange        |                    |
//     110 +----+------------+                    |
//         |bar |                                 |
//      22 +----+--+                              |
//         |  hub  |                              |
//       0 +-------+------------------------------+   plane of symmetry
//         0   10  18        35                   75
DefineConstant[ size = {2, Name "size"} ];
Point(1) = {0, 0, 0}; Point(2) = {18, 0, 0}; Point(3) = {18, 22, 0}; Point(4) = {10, 22, 0};
Point(5) = {10, 110, 0}; Point(6) = {35, 110, 0}; Point(7) = {35, 130, 0}; Point(8) = {0, 130, 0};
Point(9) = {75, 0, 0}; Point(10) = {75, 170, 0}; Point(11) = {0, 170, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 7};
Line(7) = {7, 8}; Line(8) = {8, 1}; Line(9) = {2, 9}; Line(10) = {9, 10}; Line(11) = {10, 11}; Line(12) = {11, 8};
Curve Loop(1) = {1:8}; Plane Surface(1) = {1};
Curve Loop(2) = {9, 10, 11, 12, -7, -6, -5, -4, -3, -2}; Plane Surface(2) = {2};
MeshSize{1:8} = size;
MeshSize{9, 10, 11} = 15;
Physical Surface("casting") = {1};
Physical Surface("mould") = {2};
Physical Curve("middle") = {1};
Physical Curve("outside") = {10, 11};
