// Half of a cast plate of 100 x 80 x 20 mm with a groove of 60 mm that is filled, cut along its middle; lengths in mm.
// x along the groove, z = 0 the upper side. Hexahedra; the groove has two rows of elements for each layer.
DefineConstant[ size = {1.5, Name "size"} ];  // along the groove
// The section at x = 0: columns at y of the groove's floor, its edge, the plate's edge.
Point(1) = {0, 0, -20};  Point(2) = {0, 4, -20};  Point(3) = {0, 40, -20};
Point(4) = {0, 0, -9};   Point(5) = {0, 4, -9};   Point(6) = {0, 40, -9};
Point(7) = {0, 0, 0};    Point(8) = {0, 8, 0};    Point(9) = {0, 40, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {4, 5}; Line(4) = {5, 6}; Line(5) = {7, 8}; Line(6) = {8, 9};
Line(11) = {1, 4}; Line(12) = {2, 5}; Line(13) = {3, 6}; Line(14) = {4, 7}; Line(15) = {5, 8}; Line(16) = {6, 9};
Transfinite Curve {1, 3, 5} = 5;
Transfinite Curve {2, 4, 6} = 9 Using Progression 1.25;
Transfinite Curve {-11, -12, -13} = 5 Using Progression 1.3;
Transfinite Curve {14, 15, 16} = 7;
Curve Loop(1) = {1, 12, -3, -11};  Plane Surface(1) = {1};
Curve Loop(2) = {2, 13, -4, -12};  Plane Surface(2) = {2};
Curve Loop(3) = {3, 15, -5, -14};  Plane Surface(3) = {3};  // the groove
Curve Loop(4) = {4, 16, -6, -15};  Plane Surface(4) = {4};
Transfinite Surface {1:4};
Recombine Surface {1:4};
// Three pieces along x: before the groove, along it, behind it.
plate() = {}; bead() = {}; skin() = {}; bottom() = {}; middle() = {};
For s In {1:4}
  from = s;
  For piece In {0:2}
    length = (piece == 1) ? 60 : 20;
    n = (piece == 1) ? Ceil(60/size) : 6;
    e() = Extrude {length, 0, 0} { Surface{from}; Layers{n}; Recombine; };
    If (s == 3 && piece == 1)
      bead() += e(1);
    Else
      plate() += e(1);
    EndIf
    // Sides in the order of the loop's lines.
    If (s == 1)
      bottom() += e(2);
    EndIf
    If (s == 1 || s == 3)
      middle() += e(5);
    EndIf
    If (s == 2)
      bottom() += e(2); skin() += e(3);
    EndIf
    If (s == 3)
      skin() += e(4);
    EndIf
    If (s == 4)
      skin() += {e(3), e(4)};
    EndIf
    If (piece == 2)
      skin() += e(0);
    EndIf
    from = e(0);
  EndFor
  skin() += s;
EndFor
Physical Volume("plate") = plate();
Physical Volume("bead") = bead();
Physical Surface("skin") = skin();
Physical Surface("bottom") = bottom();
Physical Surface("middle") = middle();
Physical Point("near") = {1};  // both ends of the line below the middle
Physical Point("far") = Point In BoundingBox {99.9, -0.1, -20.1, 100.1, 0.1, -19.9};
