// Three twisted blades with their platforms on a sprue with a pouring cup: a tree of an investment foundry. Lengths in mm.
SetFactory("OpenCASCADE");
// Sections of the foils, from the platform upward: thinner and turned by 15 degrees each.
For k In {0:2}
  For j In {0:2}
    c = 1000 + 10 * k + j;
    Ellipse(c) = {35, 0, 20 + 29 * j, 13 - j, 3.6 - 0.6 * j};
    Rotate {{0, 0, 1}, {35, 0, 0}, Pi / 2 + j * Pi / 12} { Curve{c}; }
    Curve Loop(c) = {c};
  EndFor
EndFor
For k In {0:2}
  ThruSections(50 + k) = {1000 + 10 * k, 1001 + 10 * k, 1002 + 10 * k};
EndFor
// The gating: a sprue of 20 mm, a cup that opens upward, and three gates.
Cylinder(1) = {0, 0, 0, 0, 0, 110, 10};
Cone(2) = {0, 0, 110, 0, 0, 26, 10, 24};
For k In {0:2}
  Box(10 + k) = {6, -6, 12, 20, 12, 14};
  Rotate {{0, 0, 1}, {0, 0, 0}, 2 * Pi * k / 3} { Volume{10 + k}; }
EndFor
BooleanUnion(30) = { Volume{1}; Delete; }{ Volume{2, 10, 11, 12}; Delete; };
// A blade: a platform at the end of the gate, and its foil.
For k In {0:2}
  Box(40 + k) = {26, -15, 12, 18, 30, 10};
  BooleanUnion(60 + k) = { Volume{40 + k}; Delete; }{ Volume{50 + k}; Delete; };
  Rotate {{0, 0, 1}, {0, 0, 0}, 2 * Pi * k / 3} { Volume{60 + k}; }
EndFor
