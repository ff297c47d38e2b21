// A crane hook: a bent bar of 28 mm with a shank of 26 mm and round ends; lengths in mm.
SetFactory("OpenCASCADE");
Torus(1) = {0,0,0, 40, 14, 3*Pi/2};
Rotate {{1,0,0},{0,0,0}, Pi/2} { Volume{1}; }
Rotate {{0,1,0},{0,0,0}, Pi} { Volume{1}; }
Cylinder(3) = {0,0,40, 0,0,60, 13};
Sphere(4) = {-40,0,0, 14};
Sphere(5) = {0,0,40, 15};
BooleanUnion(6) = {Volume{1}; Delete;}{Volume{3,4,5}; Delete;};
