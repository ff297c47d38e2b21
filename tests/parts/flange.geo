// A pipe flange with a neck: disc of 110 x 14 mm, neck of 60 mm outside, bore of 40 mm, four bolt holes and a raised face; lengths in mm.
SetFactory("OpenCASCADE");
Cylinder(1) = {0,0,0, 0,0,14, 55};
Cylinder(2) = {0,0,-3, 0,0,3, 35};
Cone(3) = {0,0,14, 0,0,12, 36, 30};
Cylinder(4) = {0,0,26, 0,0,30, 30};
BooleanUnion(5) = {Volume{1}; Delete;}{Volume{2,3,4}; Delete;};
Cylinder(6) = {0,0,-5, 0,0,80, 20};
For i In {0:3}
  Cylinder(10+i) = {43*Cos(Pi/4+i*Pi/2),43*Sin(Pi/4+i*Pi/2),-5, 0,0,30, 5.5};
EndFor
BooleanDifference(20) = {Volume{5}; Delete;}{Volume{6,10,11,12,13}; Delete;};
