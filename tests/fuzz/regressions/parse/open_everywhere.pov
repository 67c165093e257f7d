#macro M(A) #declare B = array[9] #if (A) M(A-1) "
