global_settings { integrator 10 }
