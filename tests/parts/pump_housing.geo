// A volute pump housing with its core: scroll, inlet neck, tangential outlet with flanges; lengths in mm.
SetFactory("OpenCASCADE");
Cylinder(1) = {0,0,0, 0,0,40, 60};
Cylinder(2) = {0,0,40, 0,0,35, 32};
Cylinder(3) = {0,0,67, 0,0,8, 48};
Cylinder(4) = {42,0,20, 0,95,0, 18};
Cylinder(5) = {42,87,20, 0,8,0, 32};
Cylinder(6) = {0,0,-8, 0,0,8, 68};
BooleanUnion(10) = {Volume{1}; Delete;}{Volume{2,3,4,5,6}; Delete;};
Cylinder(11) = {0,0,-22, 0,0,56, 53};
Cylinder(12) = {0,0,30, 0,0,60, 25};
Cylinder(13) = {42,0,20, 0,110,0, 11.5};
BooleanUnion(20) = {Volume{11}; Delete;}{Volume{12,13}; Delete;};
BooleanDifference(30) = {Volume{10}; Delete;}{Volume{20}; };
Physical Volume("housing") = {30};
Physical Volume("core") = {20};
