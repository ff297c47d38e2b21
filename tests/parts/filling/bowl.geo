// A bowl of 120 mm: half a shell of 6 mm with a rim and a foot; lengths in mm.
SetFactory("OpenCASCADE");
Sphere(1) = {0,0,60, 60, -Pi/2, 0, 2*Pi};
Sphere(2) = {0,0,60, 54, -Pi/2, 0, 2*Pi};
BooleanDifference(3) = {Volume{1}; Delete;}{Volume{2}; Delete;};
Cylinder(4) = {0,0,54, 0,0,8, 66};
Cylinder(5) = {0,0,53, 0,0,10, 54};
BooleanDifference(6) = {Volume{4}; Delete;}{Volume{5}; Delete;};
Cylinder(7) = {0,0,-4, 0,0,9, 22};
BooleanUnion(8) = {Volume{3}; Delete;}{Volume{6,7}; Delete;};
