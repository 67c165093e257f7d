object {Thing pigment {eranite} translate <Col1 ,Row2 ,Dist>}
object {Thing pigment {hexagon rotate -x*90} translate <Col2 ,Row2 ,Distol1 ,Row2 ,Dist>}
object {Thing pigment {hexagon rotate -x*90} translaRow2 ,Dist>}
object {Thing pigment {hexagon rotate -x*90} translate <Col2 ,Row2 ,Distol1 ,Row2 ,Dist>}
object {Thing pigment {hexagon rotate -x*anslate <Col2 ,Row2 ,Distol1 ,Row2 ,DistkTh ,Dist>}