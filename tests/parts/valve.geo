// A globe valve's body with the core that shapes its inside, an assembly of two solids; lengths in mm. The core's prints reach 15 mm into the mould at both
// ends and at the bonnet.
SetFactory("OpenCASCADE");
Sphere(1) = {0,0,0, 27};
Cylinder(2) = {-50,0,0, 100,0,0, 17};
Cylinder(3) = {-50,0,0, 14,0,0, 22}; Cylinder(4) = {36,0,0, 14,0,0, 22};
Cylinder(5) = {0,0,0, 0,0,44, 20};
Cylinder(6) = {0,0,36, 0,0,8, 26};
BooleanUnion(7) = {Volume{1}; Delete;}{Volume{2,3,4,5,6}; Delete;};
Sphere(8) = {0,0,0, 22};
Cylinder(9) = {-65,0,0, 130,0,0, 12};
Cylinder(10) = {0,0,0, 0,0,59, 15};
BooleanUnion(11) = {Volume{8}; Delete;}{Volume{9,10}; Delete;};
// The wall with the seat between inlet and outlet.
Box(12) = {-3,-24,-24, 6,48,24};
Sphere(13) = {0,0,0, 24};
BooleanIntersection(14) = {Volume{12}; Delete;}{Volume{13}; Delete;};
Box(15) = {-25,-25,-2.5, 25,50,5};
Sphere(16) = {0,0,0, 24};
BooleanIntersection(17) = {Volume{15}; Delete;}{Volume{16}; Delete;};
Cylinder(18) = {-9,0,-10, 0,0,20, 6};
BooleanDifference(19) = {Volume{17}; Delete;}{Volume{18}; Delete;};
BooleanUnion(20) = {Volume{14}; Delete;}{Volume{19}; Delete;};
BooleanDifference(21) = {Volume{11}; Delete;}{Volume{20}; };
BooleanUnion(22) = {Volume{7}; Delete;}{Volume{20}; Delete;};
BooleanDifference(23) = {Volume{22}; Delete;}{Volume{21}; };
Physical Volume("valve_body") = {23};
Physical Volume("core") = {21};
