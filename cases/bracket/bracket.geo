// An L-shaped bracket of aluminium in a block of sand, open at the top; lengths in mm. Part and sand have
// surfaces of their own where they meet: the cavity is cut with a copy of the part.
DefineConstant[ size = {8, Name "size"} ];            // of the elements in the part
DefineConstant[ sand_size = {22, Name "sand_size"} ];  // at the outside of the sand
SetFactory("OpenCASCADE");
Box(1) = {0,0,0, 100,60,15};
Box(2) = {0,0,15, 15,60,65};
BooleanUnion(3) = {Volume{1}; Delete;}{Volume{2}; Delete;};
Box(10) = {-40,-40,-40, 180,140,120};
v() = Translate{0,0,0}{Duplicata{Volume{3};}};
BooleanDifference(100) = {Volume{10}; Delete;}{Volume{v()}; Delete;};
Physical Volume("part") = {3};
Physical Volume("mould") = {100};
ps() = Abs(Boundary{Volume{3};});
ms() = Abs(Boundary{Volume{100};});
tops() = Surface In BoundingBox{-1,-1,79.9, 101,61,80.1};
cav() = Surface In BoundingBox{-1,-1,-1, 101,61,80.5};
part_surface() = {};
For i In {0:#ps()-1}
  isTop = 0;
  For j In {0:#tops()-1}
    If (ps(i)==tops(j)) isTop = 1; EndIf
  EndFor
  If (!isTop) part_surface() += ps(i); EndIf
EndFor
mould_surface() = {}; outside() = {};
For i In {0:#ms()-1}
  isC = 0;
  For j In {0:#cav()-1}
    If (ms(i)==cav(j)) isC = 1; EndIf
  EndFor
  If (isC) mould_surface() += ms(i); Else outside() += ms(i); EndIf
EndFor
Physical Surface("part_surface") = part_surface();
Physical Surface("part_top") = tops();
Physical Surface("mould_surface") = mould_surface();
Physical Surface("mould_outside") = outside();
MeshSize{ PointsOf{Volume{100};} } = sand_size;
MeshSize{ PointsOf{Volume{3};} } = size;
MeshSize{ PointsOf{Surface{mould_surface()};} } = size;
