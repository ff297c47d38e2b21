// Iron of 50 mm radius in sand of 200 mm, one layer of quadrilaterals: 10 elements along the radius in the iron, 20 in the sand.
// Millimetres; the axis is x = 0.
Point(1) = {0, 0, 0};
Point(2) = {50, 0, 0};
Point(3) = {200, 0, 0};
Point(4) = {200, 5, 0};
Point(5) = {50, 5, 0};
Point(6) = {0, 5, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Line(7) = {2, 5};
Curve Loop(1) = {1, 7, 5, 6};
Curve Loop(2) = {2, 3, 4, -7};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Transfinite Curve {1, 5} = 11;
Transfinite Curve {2, 4} = 21;
Transfinite Curve {3, 6, 7} = 2;
Transfinite Surface {1, 2};
Recombine Surface {1, 2};
Physical Surface("iron") = {1};
Physical Surface("sand") = {2};
Physical Curve("radius") = {1, 2};
