// A plate of three steps, 10, 20 and 35 mm thick, with fillets between; lengths in mm.
SetFactory("OpenCASCADE");
Box(1) = {0,0,0, 50,60,10};
Box(2) = {50,0,0, 50,60,20};
Box(3) = {100,0,0, 50,60,35};
BooleanUnion(4) = {Volume{1}; Delete;}{Volume{2,3}; Delete;};
