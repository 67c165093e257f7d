// Between four splines, each of which begins where the la (1) #declare J = J + 1; #if (J > 4) #if (1) #break #end #end #debug str(J,0,0) #end
#for (I, 1, 3) #for (J, 1, 3) #if (J = 2) #break #end #debug concat(" ", str(I,0,0), str(J,0,0)) #end #end
#for (I, 1, 3) #switch (I) #case (2) #break #debug "never" #els <0, 0, 0> + Spl1(1);
     ‡ﬂﬂ‚local P11 = <0, 0,3(0);
       #l ocal P01 = <0, 0, 0> +