// A disc with a hub, half of its section: r from the axis, z upward [mm].
size = 3;
Point(1) = {0, 0, 0, size}; Point(2) = {80, 0, 0, size}; Point(3) = {80, 10, 0, size}; Point(4) = {25, 10, 0, size};
Point(5) = {25, 40, 0, size}; Point(6) = {0, 40, 0, size};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1};
Line Loop(1) = {1, 2, 3, 4, 5, 6};
Plane Surface(1) = {1};
Physical Surface("disc") = {1};
Physical Line("skin") = {1, 2, 3, 4, 5};
Physical Point("foot") = {1};
