mesh2{vertex_vectors{1e300,<0,0,0>}
#declare I=1;