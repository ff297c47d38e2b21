// A pipe bend of 36 mm bore, walls of 6 mm, with two flanges of 80 mm, and the core that shapes its inside, an assembly of two solids; lengths in mm.
// The prints of the core reach 20 mm into the mould.
SetFactory("OpenCASCADE");
Torus(1) = {0,0,0, 80,24, Pi/2};
Torus(2) = {0,0,0, 80,18, Pi/2};
Cylinder(3) = {80,0,0, 0,-14,0, 40};
Cylinder(4) = {0,80,0, -14,0,0, 40};
BooleanUnion(10) = {Volume{1}; Delete;}{Volume{3,4}; Delete;};
Cylinder(5) = {80,0,0, 0,-34,0, 18};
Cylinder(6) = {0,80,0, -34,0,0, 18};
BooleanUnion(11) = {Volume{2}; Delete;}{Volume{5,6}; Delete;};
BooleanDifference(12) = {Volume{10}; Delete;}{Volume{11};};
Physical Volume("elbow") = {12};
Physical Volume("core") = {11};
