// A hand wheel: a rim of 240 mm, 18 x 22 mm, a hub of 52 mm and five spokes of 14 x 12 mm; lengths in mm.
SetFactory("OpenCASCADE");
Cylinder(1) = {0,0,0, 0,0,22, 120};
Cylinder(2) = {0,0,-1, 0,0,30, 102};
BooleanDifference(3) = {Volume{1}; Delete;}{Volume{2}; Delete;};
Cylinder(4) = {0,0,-6, 0,0,36, 26};
For k In {0:4}
  Box(10 + k) = {15,-7,5, 95,14,12};
  Rotate {{0,0,1}, {0,0,0}, 2*Pi*k/5} { Volume{10 + k}; }
EndFor
BooleanUnion(20) = {Volume{4}; Delete;}{Volume{3,10,11,12,13,14}; Delete;};
Cylinder(21) = {0,0,-10, 0,0,50, 11};
BooleanDifference(22) = {Volume{20}; Delete;}{Volume{21}; Delete;};
