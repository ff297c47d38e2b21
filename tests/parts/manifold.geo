// A manifold: a header of 50 mm inside and three branches with flanges, and the core within it; lengths in mm.
SetFactory("OpenCASCADE");
Cylinder(1) = {0,0,0, 240,0,0, 32};
Cylinder(2) = {0,0,0, 14,0,0, 55};
Cylinder(3) = {226,0,0, 14,0,0, 55};
For i In {0:2}
  Cylinder(10+i) = {50+70*i,0,0, 0,70,0, 22};
  Cylinder(20+i) = {50+70*i,60,0, 0,10,0, 32};
EndFor
BooleanUnion(30) = {Volume{1}; Delete;}{Volume{2,3,10:12,20:22}; Delete;};
Cylinder(40) = {-20,0,0, 280,0,0, 25};
For i In {0:2}
  Cylinder(50+i) = {50+70*i,0,0, 0,90,0, 15};
EndFor
BooleanUnion(60) = {Volume{40}; Delete;}{Volume{50:52}; Delete;};
BooleanDifference(70) = {Volume{30}; Delete;}{Volume{60};};
