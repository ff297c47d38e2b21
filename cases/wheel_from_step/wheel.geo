// A wheel of 200 mm with a hub, a web with five holes and a rim; lengths in mm, the axis is z. Makes wheel.step:
//   (cat wheel.geo; echo 'Save "wheel.step";') > save.geo && gmsh -0 save.geo
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0,   0, 0, 45,  28};      // hub
Cylinder(2) = {0, 0, 12,  0, 0, 14,  90};      // web
Cylinder(3) = {0, 0, 0,   0, 0, 40, 100};      // rim, a ring
Cylinder(4) = {0, 0, 0,   0, 0, 40,  86};
BooleanDifference(5) = { Volume{3}; Delete; }{ Volume{4}; Delete; };
BooleanUnion(6) = { Volume{1}; Delete; }{ Volume{2, 5}; Delete; };
For i In {0:4}
  Cylinder(10 + i) = {57 * Cos(2 * Pi * i / 5), 57 * Sin(2 * Pi * i / 5), 0,  0, 0, 45,  16};
EndFor
BooleanDifference(20) = { Volume{6}; Delete; }{ Volume{10:14}; Delete; };
