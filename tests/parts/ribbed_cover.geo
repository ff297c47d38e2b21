// A cover of a gear box, open below: 160 x 110 x 28 mm with walls of 3.5 mm, four screw bosses, a bearing seat and ribs of 3 mm; lengths in mm.
SetFactory("OpenCASCADE");
Box(1) = {0,0,0, 160,110,28};
Box(2) = {3.5,3.5,-1, 153,103,25.5};
BooleanDifference(3) = {Volume{1}; Delete;}{Volume{2}; Delete;};
// The seat of a bearing, and four bosses in the corners.
Cylinder(4) = {55,55,8, 0,0,20, 22};
Cylinder(11) = {10,10,0, 0,0,28, 8}; Cylinder(12) = {150,10,0, 0,0,28, 8};
Cylinder(13) = {10,100,0, 0,0,28, 8}; Cylinder(14) = {150,100,0, 0,0,28, 8};
// Ribs under the lid.
Box(21) = {2,53.5,14, 156,3,12}; Box(22) = {53.5,2,14, 3,106,12}; Box(23) = {108.5,2,16, 3,106,10};
BooleanUnion(5) = {Volume{3}; Delete;}{Volume{4,11,12,13,14,21,22,23}; Delete;};
Cylinder(31) = {55,55,-1, 0,0,40, 16};
Cylinder(41) = {10,10,-1, 0,0,40, 3.3}; Cylinder(42) = {150,10,-1, 0,0,40, 3.3};
Cylinder(43) = {10,100,-1, 0,0,40, 3.3}; Cylinder(44) = {150,100,-1, 0,0,40, 3.3};
BooleanDifference(6) = {Volume{5}; Delete;}{Volume{31,41,42,43,44}; Delete;};
