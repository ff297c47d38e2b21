// A beam with two heavy ends: cubes of 40 mm on a bar of 100 x 20 x 16 mm; lengths in mm.
SetFactory("OpenCASCADE");
Box(1) = {0,0,0, 40,40,40};
Box(2) = {140,0,0, 40,40,40};
Box(3) = {40,10,0, 100,20,16};
BooleanUnion(4) = {Volume{1}; Delete;}{Volume{2,3}; Delete;};
