// An L of two plates of 20 mm, 100 mm wide and 70 mm high, and a boss of 50 x 45 mm on the foot, which is thicker than all the rest; lengths in mm.
SetFactory("OpenCASCADE");
Box(1) = {0,0,0, 120,70,20};
Box(2) = {0,0,0, 20,70,70};
Cylinder(3) = {85,35,0, 0,0,45, 25};
BooleanUnion(4) = {Volume{1}; Delete;}{Volume{2,3}; Delete;};
