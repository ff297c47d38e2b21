// A gear case, open below: 150 x 95 x 58 mm with walls of 4 mm and a lid of 4 mm, a flange of 6 mm with four screw bosses, a bearing seat in the lid,
// and seven ribs of 3 mm outside; lengths in mm.
SetFactory("OpenCASCADE");
Box(1) = {0,0,0, 150,95,58};
Box(2) = {-10,-10,0, 170,115,6};
Cylinder(3) = {75,47,50, 0,0,18, 22};
Box(11) = {28.5,-9,6, 3,9.5,46}; Box(12) = {58.5,-9,6, 3,9.5,46}; Box(13) = {88.5,-9,6, 3,9.5,46}; Box(14) = {118.5,-9,6, 3,9.5,46};
Box(15) = {38.5,94.5,6, 3,9,40}; Box(16) = {78.5,94.5,6, 3,9,40}; Box(17) = {118.5,94.5,6, 3,9,40};
Cylinder(21) = {-3,-3,0, 0,0,12, 7}; Cylinder(22) = {153,-3,0, 0,0,12, 7};
Cylinder(23) = {-3,98,0, 0,0,12, 7}; Cylinder(24) = {153,98,0, 0,0,12, 7};
BooleanUnion(30) = {Volume{1}; Delete;}{Volume{2,3,11,12,13,14,15,16,17,21,22,23,24}; Delete;};
Box(31) = {4,4,-1, 142,87,55};
Cylinder(32) = {75,47,30, 0,0,50, 14};
Cylinder(41) = {-3,-3,-1, 0,0,20, 3.2}; Cylinder(42) = {153,-3,-1, 0,0,20, 3.2};
Cylinder(43) = {-3,98,-1, 0,0,20, 3.2}; Cylinder(44) = {153,98,-1, 0,0,20, 3.2};
BooleanDifference(50) = {Volume{30}; Delete;}{Volume{31,32,41,42,43,44}; Delete;};
