// Section of a wheel of 430 mm in a die of three parts; r along x, z along y [mm].
size = 5;       // of elements in the metal
outer = 16;     // at the outside of the die

Point(1) = {0, 0, 0, size};       Point(2) = {65, 0, 0, size};     Point(3) = {183, 16, 0, size};
Point(4) = {190, 0, 0, size};     Point(5) = {215, 0, 0, size};    Point(6) = {215, 14, 0, size};
Point(7) = {204, 22, 0, size};    Point(8) = {204, 146, 0, size};  Point(9) = {215, 153, 0, size};
Point(10) = {215, 165, 0, size};  Point(11) = {192, 165, 0, size}; Point(12) = {192, 44, 0, size};
Point(13) = {183, 36, 0, size};   Point(14) = {68, 20, 0, size};   Point(15) = {62, 45, 0, size};
Point(16) = {28, 45, 0, size};    Point(17) = {0, 45, 0, size};
Point(18) = {40, 110, 0, size};   Point(19) = {0, 110, 0, size};
Point(20) = {290, 0, 0, outer};   Point(21) = {290, -70, 0, outer}; Point(22) = {110, -70, 0, outer};
Point(23) = {0, -70, 0, outer};   Point(24) = {290, 165, 0, outer}; Point(25) = {290, 215, 0, outer};
Point(26) = {31, 215, 0, outer};

For i In {1:16}
  Line(i) = {i, i + 1};
EndFor
Line(17) = {17, 1};
Line(18) = {16, 18};  Line(19) = {18, 19};  Line(20) = {19, 17};
Line(21) = {5, 20};   Line(22) = {20, 21};  Line(23) = {21, 22};  Line(24) = {22, 23};  Line(25) = {23, 1};
Line(26) = {10, 24};  Line(27) = {24, 20};
Line(28) = {24, 25};  Line(29) = {25, 26};  Line(30) = {26, 18};

Curve Loop(1) = {1:17};                             Plane Surface(1) = {1};
Curve Loop(2) = {18, 19, 20, -16};                  Plane Surface(2) = {2};
Curve Loop(3) = {-4, -3, -2, -1, -25, -24, -23, -22, -21};  Plane Surface(3) = {3};
Curve Loop(4) = {-9, -8, -7, -6, -5, 21, -27, -26};     Plane Surface(4) = {4};
Curve Loop(5) = {-15, -14, -13, -12, -11, -10, 26, 28, 29, 30, -18};  Plane Surface(5) = {5};

Physical Surface("wheel") = {1};
Physical Surface("riser") = {2};
Physical Surface("bottom") = {3};
Physical Surface("side") = {4};
Physical Surface("core") = {5};
Physical Curve("wheel_axis") = {17};
Physical Curve("riser_axis") = {20};
Physical Curve("below_hub") = {24};
