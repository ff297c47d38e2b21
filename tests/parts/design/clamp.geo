// A clamp: a plate of 110 x 60 x 18 mm and two upright lugs of 22 mm with bores of 16 mm; lengths in mm.
SetFactory("OpenCASCADE");
Box(1) = {0,0,0, 110,60,18};
Box(2) = {10,0,18, 22,60,32};
Box(3) = {78,0,18, 22,60,32};
BooleanUnion(4) = {Volume{1}; Delete;}{Volume{2,3}; Delete;};
Cylinder(5) = {-5,30,36, 130,0,0, 8};
BooleanDifference(7) = {Volume{4}; Delete;}{Volume{5}; Delete;};
