// Half of a shaft whose worn seat is built up by three layers, cut at the middle of the seat (y = 0); lengths in mm. x is the
// radius. Quadrilaterals, two rows for each layer of 2 mm.
DefineConstant[ fine = {1, Name "fine"} ];  // elements along every line, times this
Point(1) = {0, 0, 0};    Point(2) = {30, 0, 0};   Point(3) = {36, 0, 0};
Point(4) = {0, 20, 0};   Point(5) = {30, 20, 0};  Point(6) = {36, 20, 0};
Point(7) = {0, 60, 0};   Point(8) = {30, 60, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {4, 5}; Line(4) = {5, 6}; Line(5) = {7, 8};
Line(11) = {1, 4}; Line(12) = {2, 5}; Line(13) = {3, 6}; Line(14) = {4, 7}; Line(15) = {5, 8};
Transfinite Curve {-1, -3, -5} = 10*fine + 1 Using Progression 1.2^(1/fine);
Transfinite Curve {2, 4} = 6*fine + 1;
Transfinite Curve {11, 12, 13} = 10*fine + 1;
Transfinite Curve {14, 15} = 12*fine + 1 Using Progression 1.1^(1/fine);
Curve Loop(1) = {1, 12, -3, -11};  Plane Surface(1) = {1};
Curve Loop(2) = {2, 13, -4, -12};  Plane Surface(2) = {2};  // the layers
Curve Loop(3) = {3, 15, -5, -14};  Plane Surface(3) = {3};
Transfinite Surface {1:3};
Recombine Surface {1:3};
Physical Surface("shaft") = {1, 3};
Physical Surface("layers") = {2};
Physical Curve("skin") = {4, 5, 13, 15};
Physical Curve("middle") = {1, 2};
