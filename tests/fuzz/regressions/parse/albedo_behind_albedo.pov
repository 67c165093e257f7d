sphere { 0, 1 finish { albedo 1 albedo 1 } }
