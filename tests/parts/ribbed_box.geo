// A tray of 200 x 120 x 70 mm with walls of 5 mm, inner ribs of 4 mm, four bosses; lengths in mm.
SetFactory("OpenCASCADE");
Box(1) = {0,0,0, 200,120,70};
Box(2) = {5,5,5, 190,110,70};
BooleanDifference(3) = {Volume{1}; Delete;}{Volume{2}; Delete;};
Box(4) = {64,5,5, 4,110,45}; Box(5) = {132,5,5, 4,110,45}; Box(6) = {5,58,5, 190,4,30};
For i In {0:1}
  For j In {0:1}
    Cylinder(10+2*i+j) = {16+168*i, 16+88*j, 3, 0,0,67, 11};
  EndFor
EndFor
Box(20) = {-15,50,0, 16,20,12}; Box(21) = {199,50,0, 16,20,12};
BooleanUnion(30) = {Volume{3}; Delete;}{Volume{4,5,6,10:13,20,21}; Delete;};
For i In {0:1}
  For j In {0:1}
    Cylinder(40+2*i+j) = {16+168*i, 16+88*j, 20, 0,0,60, 4};
  EndFor
EndFor
Cylinder(50) = {-8,60,-5, 0,0,30, 4}; Cylinder(51) = {208,60,-5, 0,0,30, 4};
BooleanDifference(60) = {Volume{30}; Delete;}{Volume{40:43,50,51}; Delete;};
