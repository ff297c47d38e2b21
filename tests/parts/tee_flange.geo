// A pipe tee of 60 mm with three bolted flanges, hollow; lengths in mm.
SetFactory("OpenCASCADE");
Cylinder(1) = {-90,0,0, 180,0,0, 36};
Cylinder(2) = {0,0,0, 0,0,90, 36};
Cylinder(3) = {-90,0,0, 14,0,0, 60}; Cylinder(4) = {76,0,0, 14,0,0, 60}; Cylinder(5) = {0,0,76, 0,0,14, 60};
BooleanUnion(6) = {Volume{1}; Delete;}{Volume{2,3,4,5}; Delete;};
Cylinder(7) = {-100,0,0, 200,0,0, 28};
Cylinder(8) = {0,0,0, 0,0,100, 28};
BooleanDifference(9) = {Volume{6}; Delete;}{Volume{7,8}; Delete;};
For i In {0:3}
  a = Pi/4 + i*Pi/2;
  Cylinder(20+i) = {-95, 48*Cos(a), 48*Sin(a), 30,0,0, 5.5};
  Cylinder(30+i) = {65, 48*Cos(a), 48*Sin(a), 30,0,0, 5.5};
  Cylinder(40+i) = {48*Cos(a), 48*Sin(a), 65, 0,0,30, 5.5};
EndFor
BooleanDifference(50) = {Volume{9}; Delete;}{Volume{20:23,30:33,40:43}; Delete;};
