// A pump impeller of 160 mm: back plate of 6 mm, hub with bore, seven backward curved blades of 5 mm; lengths in mm.
SetFactory("OpenCASCADE");
Cylinder(1) = {0,0,0, 0,0,6, 80};
Cone(2) = {0,0,0, 0,0,45, 28, 18};
n = 7;
blades[] = {};
For i In {0:n-1}
  a = 2*Pi*i/n;
  // A blade is a part of a ring: between two circles around a centre next to the axis.
  cx = 38*Cos(a) - 30*Sin(a); cy = 38*Sin(a) + 30*Cos(a);
  Cylinder(100+i) = {cx,cy,3, 0,0,27, 42.5};
  Cylinder(200+i) = {cx,cy,3, 0,0,27, 37.5};
  BooleanDifference(300+i) = {Volume{100+i}; Delete;}{Volume{200+i}; Delete;};
  Box(400+i) = {0,-90,0, 100,90,60};
  Rotate{{0,0,1},{0,0,0}, a - 0.25}{Volume{400+i};}
  BooleanIntersection(500+i) = {Volume{300+i}; Delete;}{Volume{400+i}; Delete;};
EndFor
Cylinder(600) = {0,0,0, 0,0,40, 79};
b[] = BooleanIntersection{Volume{500:506}; Delete;}{Volume{600}; Delete;};
u[] = BooleanUnion{Volume{1}; Delete;}{Volume{2}; Volume{b[]}; Delete;};
Cylinder(900) = {0,0,-5, 0,0,60, 9};
BooleanDifference(1000) = {Volume{u[]}; Delete;}{Volume{900}; Delete;};
