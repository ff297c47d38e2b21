// A plate of 180 x 60 mm with steps of 40, 20 and 10 mm, a riser of 44 mm on its thick end, a chill before its thin one.
// An assembly of three solids; lengths in mm.
SetFactory("OpenCASCADE");
Box(1) = {0,0,0, 60,60,40};
Box(2) = {60,0,0, 60,60,20};
Box(3) = {120,0,0, 60,60,10};
BooleanUnion(4) = {Volume{1}; Delete;}{Volume{2,3}; Delete;};
Cylinder(5) = {30,30,40, 0,0,50, 22};
Box(6) = {180,0,-10, 20,60,30};
