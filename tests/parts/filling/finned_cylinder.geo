// A cylinder of an engine: a sleeve of 6 mm wall, a flange at its foot, six cooling fins of 4 mm; lengths in mm.
SetFactory("OpenCASCADE");
Cylinder(1) = {0,0,0, 0,0,90, 31};
Box(2) = {-45,-45,0, 90,90,10};
For i In {0:5}
  Cylinder(10+i) = {0,0,20+12*i, 0,0,4, 44};
EndFor
BooleanUnion(30) = {Volume{1}; Delete;}{Volume{2,10:15}; Delete;};
Cylinder(31) = {0,0,-1, 0,0,92, 25};
BooleanDifference(32) = {Volume{30}; Delete;}{Volume{31}; Delete;};
