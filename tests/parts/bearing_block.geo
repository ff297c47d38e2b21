// A base plate of 160 x 80 x 16 mm with two bearing bosses, and what belongs to its mould: a riser of 56 mm with a sleeve of 10 mm on the large boss,
// a chill of 44 x 44 x 20 mm below the small one. An assembly of four solids; lengths in mm.
SetFactory("OpenCASCADE");
Box(1) = {0,0,0, 160,80,16};
Cylinder(2) = {45,40,0, 0,0,45, 32};
Cylinder(3) = {130,40,0, 0,0,30, 18};
BooleanUnion(4) = {Volume{1}; Delete;}{Volume{2,3}; Delete;};
Cylinder(5) = {130,40,-1, 0,0,40, 8};
BooleanDifference(6) = {Volume{4}; Delete;}{Volume{5}; Delete;};
Cylinder(7) = {45,40,45, 0,0,70, 28};
Cylinder(8) = {45,40,45, 0,0,70, 38};
BooleanDifference(9) = {Volume{8}; Delete;}{Volume{7};};
Box(10) = {108,18,-20, 44,44,20};
Physical Volume("bearing_block") = {6};
Physical Volume("riser") = {7};
Physical Volume("sleeve") = {9};
Physical Volume("chill") = {10};
