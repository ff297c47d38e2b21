// Billet and starting block of a direct-chill casting; lengths in mm. x is the radius, the foot of the billet is at y = 0.
// Billet and block have nodes of their own where they touch. Quadrilaterals.
DefineConstant[ rows = {5, Name "rows"} ];        // height of the billet's rows of elements [mm]
DefineConstant[ columns = {12, Name "columns"} ]; // of elements, finer at the rim
DefineConstant[ height = {1500, Name "height"} ]; // of the billet in the end [mm]
Point(1) = {0, 0, 0};   Point(2) = {77.5, 0, 0};   Point(3) = {77.5, height, 0};   Point(4) = {0, height, 0};
Point(5) = {0, -60, 0}; Point(6) = {77.5, -60, 0}; Point(7) = {77.5, 0, 0};        Point(8) = {0, 0, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};
Transfinite Curve {1, -3} = columns + 1 Using Progression 1/1.08;
Transfinite Curve {5, -7} = columns + 1 Using Progression 1/1.08;
Transfinite Curve {2, 4} = height/rows + 1;
Transfinite Curve {6, 8} = 9;
Curve Loop(1) = {1, 2, 3, 4};  Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, 8};  Plane Surface(2) = {2};
Transfinite Surface {1, 2};
Recombine Surface {1, 2};
Physical Surface("block") = {1};
Physical Surface("starting_block") = {2};
Physical Curve("y_min") = {1};
Physical Curve("x_max") = {2};
Physical Curve("y_max") = {3};
Physical Curve("block_base") = {5};
Physical Curve("block_side") = {6};
Physical Curve("block_top") = {7};
