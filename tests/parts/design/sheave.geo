// A sheave of 200 mm with five hot spots: a disc of 9 mm, a hub and four pads of 34 x 34 mm on it; lengths in mm.
SetFactory("OpenCASCADE");
Cylinder(1) = {0,0,0, 0,0,9, 100};
Cylinder(2) = {0,0,0, 0,0,34, 17};
Cylinder(11) = {76,0,0, 0,0,34, 17}; Cylinder(12) = {-76,0,0, 0,0,34, 17};
Cylinder(13) = {0,76,0, 0,0,34, 17}; Cylinder(14) = {0,-76,0, 0,0,34, 17};
BooleanUnion(20) = {Volume{1}; Delete;}{Volume{2,11:14}; Delete;};
