"""What is done to a model so that a fault shows: each probe gives one number, small where the model is well."""
