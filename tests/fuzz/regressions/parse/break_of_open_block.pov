#if (1)
  #for (i, 1, 2)
  #break
#else
1