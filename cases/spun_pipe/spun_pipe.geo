// A slice of a pipe in the die in which it is cast by rotation. Axisymmetric: x is the radius, y along the axis,
// lengths in mm. Pipe and die have nodes of their own.
//
//     20 +--------+----------------+
//        |  pipe  |      die       |
//      0 +--------+----------------+
//       80       100              140
DefineConstant[ layers = {10, Name "elements through the wall of the pipe"} ];
Point(1) = {80, 0, 0}; Point(2) = {100, 0, 0}; Point(3) = {100, 20, 0}; Point(4) = {80, 20, 0};
Point(5) = {100, 0, 0}; Point(6) = {140, 0, 0}; Point(7) = {140, 20, 0}; Point(8) = {100, 20, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Curve Loop(2) = {5:8}; Plane Surface(2) = {2};
Transfinite Curve{1, 3} = layers + 1; Transfinite Curve{5, -7} = 9 Using Progression 1.15;
Transfinite Curve{2, 4, 6, 8} = 7;
Transfinite Surface{1, 2};
Physical Surface("pipe") = {1};
Physical Surface("die") = {2};
Physical Curve("bore") = {4};
Physical Curve("outside") = {6};
Physical Curve("foot") = {1, 5};
Physical Curve("pipe_end") = {3};
Physical Curve("die_end") = {7};
