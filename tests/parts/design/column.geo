// A column: a heavy foot of 60 x 60 x 40 mm below a web of 10 mm, which carries a head of 40 x 50 x 24 mm: what stands on the head cannot feed the foot; lengths in mm.
SetFactory("OpenCASCADE");
Box(1) = {0,0,0, 60,60,40};
Box(2) = {10,25,40, 40,10,50};
Box(3) = {10,5,90, 40,50,24};
BooleanUnion(4) = {Volume{1}; Delete;}{Volume{2,3}; Delete;};
