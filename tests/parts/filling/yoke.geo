// A yoke: two ears of 14 mm on a base, a shank below, bored through the ears; lengths in mm.
SetFactory("OpenCASCADE");
Box(1) = {-40,-22,0, 80,44,18};
Box(2) = {-40,-22,0, 14,44,60};
Box(3) = {26,-22,0, 14,44,60};
Cylinder(4) = {-40,0,60, 14,0,0, 22};
Cylinder(5) = {26,0,60, 14,0,0, 22};
Cylinder(6) = {0,0,-50, 0,0,60, 15};
BooleanUnion(7) = {Volume{1}; Delete;}{Volume{2,3,4,5,6}; Delete;};
Cylinder(8) = {-50,0,60, 100,0,0, 11};
BooleanDifference(9) = {Volume{7}; Delete;}{Volume{8}; Delete;};
